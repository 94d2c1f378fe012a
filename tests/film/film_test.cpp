#include <tests/sampling/verdicts.h>
#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/film/film.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace wend {
namespace {

const Layer& layer(const Picture& picture, const std::string& name) {
    return *std::find_if(picture.layers.begin(), picture.layers.end(), [&](const Layer& l) { return l.name == name; });
}

FilmSample sample_of(const Rgb& radiance) {
    FilmSample sample;
    sample.radiance = radiance;
    return sample;
}

Film one_pixel() {
    return Film({1, 1}, {{0, 0}, {1, 1}});
}

TEST(Film, AveragesItsSamples) {
    Film film({4, 3}, {{0, 0}, {4, 3}});
    film.add({1, 2}, sample_of({1, 2, 3}));
    film.add({1, 2}, sample_of({3, 2, 1}));
    film.add_features({1, 2}, {Rgb(0.5f), {0, 0, 1}, 4, 0.5f, 1});
    film.add_features({1, 2}, {Rgb(0.1f), {0, 1, 0}, 2, 0, 0.25f});
    film.begin_stage();
    const Picture picture = film.picture();
    EXPECT_EQ(picture.image.at(1, 2), Rgb(2));
    EXPECT_EQ(picture.image.at(0, 0), Rgb(0));
    const std::size_t i = 2 * 4 + 1;
    EXPECT_FLOAT_EQ(layer(picture, "albedo").values[3 * i], 0.3f);
    EXPECT_FLOAT_EQ(layer(picture, "normal").values[3 * i + 2], 0.5f);
    EXPECT_FLOAT_EQ(layer(picture, "depth").values[i], 3);
    EXPECT_FLOAT_EQ(layer(picture, "scatter").values[i], 0.25f);
    EXPECT_FLOAT_EQ(layer(picture, "alpha").values[i], 0.625f);
    EXPECT_EQ(layer(picture, "samples").values[i], 2);
    EXPECT_EQ(layer(picture, "samples").values[0], 0);
}

TEST(Film, TellsWhatWalksDid) {
    Film film({2, 1}, {{0, 0}, {2, 1}});
    FilmSample sample = sample_of(Rgb(1));
    sample.segments = 7;
    film.add({0, 0}, sample);
    film.begin_stage();
    sample.segments = 5;
    sample.branches = 4;
    sample.guided = true;
    film.add({0, 0}, sample);
    const Picture picture = film.picture();
    EXPECT_EQ(layer(picture, "guided").values, (std::vector<float>{0.5f, 0}));
    EXPECT_EQ(layer(picture, "segments").values, (std::vector<float>{6, 0}));
    EXPECT_EQ(layer(picture, "branches").values, (std::vector<float>{2.5f, 0}));
}

TEST(Film, CountsLongWalksExactly) {
    // More segments than a float can count one by one.
    Film film = one_pixel();
    FilmSample sample;
    sample.segments = 1u << 25;
    film.add({0, 0}, sample);
    for (int i = 0; i < 3; ++i) {
        sample.segments = 1;
        film.add({0, 0}, sample);
    }
    EXPECT_EQ(layer(film.picture(), "segments").values[0], static_cast<float>(((1u << 25) + 3) / 4.0));
}

TEST(Film, VarianceIsThatOfTheMean) {
    Film film = one_pixel();
    for (const float v : {1.0f, 2.0f, 3.0f, 6.0f}) {
        film.add({0, 0}, sample_of(Rgb(v)));
    }
    // Sample variance 14/3, over 4 samples.
    EXPECT_NEAR(layer(film.picture(), "variance").values[1], 14.0 / 3 / 4, 1e-6);
}

TEST(Film, MeansScatterAsTheVarianceSays) {
    // Many pixels of 16 skewed samples each: the mean of the variances against the scatter of the means.
    constexpr int pixels = 100000, samples = 16;
    Film film({pixels, 1}, {{0, 0}, {pixels, 1}});
    Pcg32 random(1);
    for (int x = 0; x < pixels; ++x) {
        for (int s = 0; s < samples; ++s) {
            film.add({x, 0}, sample_of(Rgb(random.uniform(), sqr(random.uniform()), 1)));
        }
    }
    const Picture picture = film.picture();
    const auto& variance = layer(picture, "variance").values;
    Moments red, green, squared_deviation;
    for (int x = 0; x < pixels; ++x) {
        red.add(variance[3 * static_cast<std::size_t>(x)]);
        green.add(variance[3 * static_cast<std::size_t>(x) + 1]);
        squared_deviation.add(std::pow(picture.image.at(x, 0).g - 1.0 / 3, 2));
        EXPECT_EQ(variance[3 * static_cast<std::size_t>(x) + 2], 0);
    }
    EXPECT_TRUE(test::is_within_one_percent(red, 1.0 / 12 / samples));
    EXPECT_TRUE(test::is_within_one_percent(green, (1.0 / 5 - 1.0 / 9) / samples));
    EXPECT_TRUE(agrees(squared_deviation, green.mean(), 5));
    EXPECT_FALSE(agrees(squared_deviation, green.mean() * samples / (samples - 1.0), 5));
}

TEST(Film, AStageOfLessVarianceCountsMore) {
    constexpr int side = 100, samples = 32;
    Film film({side, side}, {{0, 0}, {side, side}});
    Pcg32 random(2);
    const auto add_stage = [&](float spread) {
        for (int y = 0; y < side; ++y) {
            for (int x = 0; x < side; ++x) {
                for (int s = 0; s < samples; ++s) {
                    film.add({x, y}, sample_of(Rgb(1 + spread * (random.uniform() - 0.5f))));
                }
            }
        }
    };
    add_stage(1.9f);
    film.begin_stage();
    add_stage(0.19f);
    const Picture picture = film.picture();
    Moments deviation, reported;
    for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
        deviation.add(sqr(static_cast<double>(picture.image.pixels[i].r) - 1));
        reported.add(static_cast<double>(layer(picture, "variance").values[3 * i]));
        EXPECT_EQ(layer(picture, "samples").values[i], 2 * samples);
    }
    const double first = 1.9 * 1.9 / 12 / samples, second = first / 100, best = 1 / (1 / first + 1 / second);
    EXPECT_TRUE(agrees(deviation, best, 5)) << deviation.mean() / best;
    EXPECT_FALSE(agrees(deviation, (first + second) / 4, 5));
    EXPECT_NEAR(reported.mean() / best, 1, 0.01);
}

TEST(Film, WeightsOfStagesDoNotDarkenThePicture) {
    // Values of a rare kind, then of an ordinary one, with the same mean of 1, on films so small that a sample has much
    // to say about the variance. Weighted by the variance among themselves, they come out too dark.
    constexpr int side = 4, samples = 8, films = 20000;
    constexpr float rare = 0.05f;
    Pcg32 random(3);
    Moments means, naive;
    for (int i = 0; i < films; ++i) {
        Film both({side, side}, {{0, 0}, {side, side}});
        Film stages[2] = {both, both};
        for (int stage = 0; stage < 2; ++stage) {
            for (int k = 0; k < side * side * samples; ++k) {
                const float u = random.uniform();
                const Rgb value(stage == 0 ? (u < rare ? 1 / rare : 0.0f) : 2 * u);
                const Vec2i pixel(k % side, k / side % side);
                both.add(pixel, sample_of(value));
                stages[stage].add(pixel, sample_of(value));
            }
            if (stage == 0) {
                both.begin_stage();
            }
        }
        double total = 0, weights = 0;
        for (const Film& stage : stages) {
            const Picture picture = stage.picture();
            double mean = 0, variance = 0;
            for (std::size_t p = 0; p < picture.image.pixels.size(); ++p) {
                mean += static_cast<double>(picture.image.pixels[p].r) / (side * side);
                variance += static_cast<double>(layer(picture, "variance").values[3 * p]);
            }
            total += mean / variance;
            weights += 1 / variance;
        }
        naive.add(total / weights);
        double mean = 0;
        for (const Rgb& pixel : both.beauty().pixels) {
            mean += static_cast<double>(pixel.r) / (side * side);
        }
        means.add(mean);
    }
    EXPECT_TRUE(test::is_within_one_percent(means, 1)) << means.mean();
    EXPECT_FALSE(agrees(naive, 1, 5)) << naive.mean();
}

/// Over many small films, what a last stage costs that is as noisy as the one before: the squared error of films over
/// that of the plain mean of all samples. Also the mean of all films, which is 1.
struct CostOfAStage {
    Moments squared_error, plain_squared_error, mean;

    /// `samples` of each pixel in the first stage; in the last one, so many as a mean, given out by chance.
    CostOfAStage(int samples, float last, int films) {
        constexpr int side = 16;
        Pcg32 random(6);
        // Skewed, as light is: few samples seldom show how much they vary.
        const auto exponential = [&] { return -std::log(1 - random.uniform()); };
        const auto value = [&] { return exponential() * exponential() * exponential(); };
        for (int k = 0; k < films; ++k) {
            Film film({side, side}, {{0, 0}, {side, side}});
            std::vector<double> sums(side * side, 0), counts(side * side, 0);
            const auto add = [&](int pixel) {
                const float v = value();
                film.add({pixel % side, pixel / side}, sample_of(Rgb(v)));
                sums[static_cast<std::size_t>(pixel)] += static_cast<double>(v);
                ++counts[static_cast<std::size_t>(pixel)];
            };
            for (int i = 0; i < samples * side * side; ++i) {
                add(i % (side * side));
            }
            film.begin_stage();
            for (int i = 0; i < static_cast<int>(last * side * side); ++i) {
                add(static_cast<int>(random.uniform() * side * side));
            }
            const Image picture = film.beauty();
            double sum = 0;
            for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
                const double shown = static_cast<double>(picture.pixels[i].r);
                sum += shown / (side * side);
                squared_error.add(sqr(shown - 1));
                plain_squared_error.add(sqr(sums[i] / counts[i] - 1));
            }
            mean.add(sum);
        }
    }

    double ratio() const { return squared_error.mean() / plain_squared_error.mean(); }
};

TEST(Film, ALastStageOfFewSamplesHasLittleToSay) {
    const CostOfAStage cost(63, 1, 400);
    EXPECT_LT(cost.ratio(), 1.01);
    EXPECT_TRUE(test::is_within_one_percent(cost.mean, 1)) << cost.mean.mean();
}

TEST(Film, AStageThatIsAsNoisyAsTheOneBeforeCostsLittle) {
    const CostOfAStage cost(7, 9, 1000);
    EXPECT_LT(cost.ratio(), 1.01);
    EXPECT_TRUE(test::is_within_one_percent(cost.mean, 1)) << cost.mean.mean();
}

TEST(Film, AStageThatLacksLightCountsLess) {
    // In the first stage nearly all light comes with values that are too rare to have come yet: it seems to vary
    // little.
    constexpr int side = 64, samples = 16;
    Film film({side, side}, {{0, 0}, {side, side}});
    Pcg32 random(4);
    for (int stage = 0; stage < 2; ++stage) {
        for (int k = 0; k < side * side * samples; ++k) {
            const float u = random.uniform();
            film.add({k % side, k / side % side}, sample_of(Rgb(stage == 0 ? 0.1f * (0.5f + u) : 2 * u)));
        }
        if (stage == 0) {
            film.begin_stage();
        }
    }
    double mean = 0;
    for (const Rgb& pixel : film.beauty().pixels) {
        mean += static_cast<double>(pixel.g) / (side * side);
    }
    EXPECT_NEAR(mean, 1, 0.01);
}

TEST(Film, AStageOfOneSampleCountsAsTheOneBefore) {
    Film film({2, 1}, {{0, 0}, {2, 1}});
    for (const float value : {1.0f, 3.0f}) {
        film.add({0, 0}, sample_of(Rgb(value)));
        film.add({1, 0}, sample_of(Rgb(value)));
    }
    film.begin_stage();
    film.add({0, 0}, sample_of(Rgb(8)));
    EXPECT_EQ(film.beauty().at(0, 0), Rgb(4));
    EXPECT_EQ(film.beauty().at(1, 0), Rgb(2));
}

TEST(Film, StagesOfOneSampleHaveTheVarianceOfThoseBefore) {
    constexpr int pixels = 4000, samples = 8, single_stages = 4;
    Film film({pixels, 1}, {{0, 0}, {pixels, 1}});
    Pcg32 random(5);
    const auto add = [&] {
        for (int x = 0; x < pixels; ++x) {
            film.add({x, 0}, sample_of(Rgb(random.uniform())));
        }
    };
    for (int i = 0; i < samples; ++i) {
        add();
    }
    for (int i = 0; i < single_stages; ++i) {
        film.begin_stage();
        add();
    }
    const Picture picture = film.picture();
    double sum = 0;
    for (int x = 0; x < pixels; ++x) {
        sum += static_cast<double>(layer(picture, "variance").values[3 * static_cast<std::size_t>(x)]);
    }
    EXPECT_NEAR(sum / pixels * (samples + single_stages), 1.0 / 12, 0.02 / 12);
}

TEST(Film, RejectedSamplesCountAsBlack) {
    Film film = one_pixel();
    film.add({0, 0}, sample_of(Rgb(4)));
    film.reject({0, 0});
    EXPECT_EQ(film.beauty().at(0, 0), Rgb(2));
    EXPECT_EQ(layer(film.picture(), "samples").values[0], 2);
}

TEST(Film, CropKeepsFullCoordinates) {
    Film film({100, 50}, {{10, 20}, {13, 22}});
    film.add({12, 21}, sample_of(Rgb(1)));
    const Picture picture = film.picture();
    EXPECT_EQ(picture.image.width, 3);
    EXPECT_EQ(picture.image.height, 2);
    EXPECT_EQ(picture.offset, Vec2i(10, 20));
    EXPECT_EQ(picture.full_size, Vec2i(100, 50));
    EXPECT_EQ(picture.image.at(2, 1), Rgb(1));
}

TEST(Film, RelativeNoiseIsTheStandardErrorOverTheMean) {
    Film film = one_pixel();
    EXPECT_EQ(film.relative_noise(), 0);
    for (int i = 0; i < 100; ++i) {
        film.add({0, 0}, sample_of(Rgb(i % 2 ? 3.0f : 1.0f)));
    }
    EXPECT_NEAR(film.relative_noise(), 0.5 / std::sqrt(99), 1e-6);
}

TEST(Film, RefusesWindowsItCannotHold) {
    const auto make = [](const Vec2i& size, const PixelRect& crop) { Film film(size, crop); };
    EXPECT_THROW(make({0, 5}, {{0, 0}, {0, 5}}), InputError);
    EXPECT_THROW(make({5, 5}, {{2, 2}, {2, 4}}), InputError);
    EXPECT_THROW(make({5, 5}, {{0, 0}, {6, 5}}), InputError);
    EXPECT_THROW(make({5, 5}, {{-1, 0}, {5, 5}}), InputError);
    EXPECT_THROW(make({2000000000, 2000000000}, {{0, 0}, {2000000000, 2000000000}}), InputError);
}

}  // namespace
}  // namespace wend
