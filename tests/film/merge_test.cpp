#include <tests/sampling/verdicts.h>
#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/film/cryptomatte.h>
#include <wend/film/film.h>
#include <wend/film/merge.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace wend {
namespace {

Layer& layer(Picture& picture, const std::string& name) {
    return *std::find_if(picture.layers.begin(), picture.layers.end(), [&](const Layer& l) { return l.name == name; });
}

const std::vector<float>& values(const Picture& picture, const std::string& name) {
    return layer(const_cast<Picture&>(picture), name).values;
}

MergedPictures merge(const std::vector<Picture>& pictures) {
    return merge_pictures(pictures.size(), [&](std::size_t k) { return pictures[k]; });
}

/// Values with the mean 1.
using Noise = float (*)(Pcg32&);

float ordinary(Pcg32& random) {
    return 2 * random.uniform();
}
/// One in twenty is bright, the others are black: variance 19.
float rare(Pcg32& random) {
    return random.uniform() < 0.05f ? 20.0f : 0.0f;
}

float flat(int) {
    return 1;
}
/// The right side is a hundred times as bright as the left one of a picture of four columns; the mean is 1.
float steep(int x) {
    return (1 + 33 * static_cast<float>(x)) / 50.5f;
}

/// A square picture whose samples are that noise times the brightness of their column.
Picture noisy(int side, int samples, Noise noise, Pcg32& random, float (*brightness)(int) = flat) {
    Film film({side, side}, {{0, 0}, {side, side}});
    for (int k = 0; k < side * side * samples; ++k) {
        const Vec2i pixel(k % side, k / side % side);
        FilmSample sample;
        sample.radiance = Rgb(noise(random) * brightness(pixel.x));
        film.add(pixel, sample);
    }
    return film.picture();
}

double mean_of(const Image& image) {
    double sum = 0;
    for (const Rgb& pixel : image.pixels) {
        sum += static_cast<double>(pixel.g);
    }
    return sum / static_cast<double>(image.pixels.size());
}

double mean_of(const std::vector<float>& numbers) {
    double sum = 0;
    for (const float v : numbers) {
        sum += static_cast<double>(v);
    }
    return sum / static_cast<double>(numbers.size());
}

/// Weighted by their own variance pixel by pixel, as one should not.
double naive_by_pixel(const std::vector<Picture>& pictures) {
    double sum = 0;
    const std::size_t pixels = pictures.front().image.pixels.size();
    for (std::size_t i = 0; i < pixels; ++i) {
        double weights = 0, weighted = 0;
        for (const Picture& picture : pictures) {
            const double w = 1 / std::max(static_cast<double>(values(picture, "variance")[3 * i + 1]), 1e-3);
            weights += w;
            weighted += w * static_cast<double>(picture.image.pixels[i].g);
        }
        sum += weighted / weights;
    }
    return sum / static_cast<double>(pixels);
}

/// Weighted by the variance of the whole picture, without a chess board.
double naive_by_picture(const std::vector<Picture>& pictures) {
    double weights = 0, weighted = 0;
    for (const Picture& picture : pictures) {
        const double w = 1 / std::max(mean_of(values(picture, "variance")), 1e-3);
        weights += w;
        weighted += w * mean_of(picture.image);
    }
    return weighted / weights;
}

TEST(Merge, WeightsDoNotDarkenThePicture) {
    // Pictures so small that a sample has much to say about the variance, of rare bright samples and of ordinary ones:
    // 20,000 merges of three pictures with 4 x 4 pixels. Twins that weigh by what they measure are too dark.
    constexpr int side = 4, merges = 20000;
    Pcg32 random(1);
    for (const auto brightness : {flat, steep}) {
        Moments means, by_pixel, by_picture;
        for (int i = 0; i < merges; ++i) {
            const std::vector<Picture> pictures = {noisy(side, 8, rare, random, brightness),
                                                   noisy(side, 8, rare, random, brightness),
                                                   noisy(side, 4, ordinary, random, brightness)};
            means.add(mean_of(merge(pictures).picture.image));
            by_pixel.add(naive_by_pixel(pictures));
            by_picture.add(naive_by_picture(pictures));
        }
        EXPECT_TRUE(test::is_within_one_percent(means, 1));
        EXPECT_FALSE(agrees(by_pixel, 1, 5)) << by_pixel.mean();
        EXPECT_FALSE(agrees(by_picture, 1, 5)) << by_picture.mean();
    }
}

TEST(Merge, MergesOfMergesDoNotDarkenThePicture) {
    // The variances of a merged picture depend a little on both halves, by the weights that it was made with.
    constexpr int side = 4, merges = 20000;
    Pcg32 random(2);
    Moments means;
    for (int i = 0; i < merges; ++i) {
        const auto pair = [&] {
            return merge({noisy(side, 8, rare, random), noisy(side, 8, ordinary, random)}).picture;
        };
        const Picture first = pair();
        means.add(mean_of(merge({first, pair(), noisy(side, 8, rare, random)}).picture.image));
    }
    EXPECT_TRUE(test::is_within_one_percent(means, 1));
}

/// Squared deviations of merged pictures from the mean, and what their layer says of them.
struct Deviations {
    Moments measured, told;
    double worth = 0;  ///< of the last picture's samples over those of the first

    Deviations(int side, int merges, const std::vector<std::pair<int, Noise>>& kinds, std::uint64_t seed) {
        Pcg32 random(seed);
        for (int i = 0; i < merges; ++i) {
            std::vector<Picture> pictures;
            for (const auto& [samples, noise] : kinds) {
                pictures.push_back(noisy(side, samples, noise, random));
            }
            const MergedPictures merged = merge(pictures);
            double sum = 0;
            for (const Rgb& pixel : merged.picture.image.pixels) {
                sum += sqr(static_cast<double>(pixel.r) - 1);
            }
            measured.add(sum / (side * side));
            told.add(mean_of(values(merged.picture, "variance")));
            worth += merged.shares.back() * kinds.front().first / (merged.shares.front() * kinds.back().first) / merges;
        }
    }

    /// Within 5 %, and precise enough to see 5 %, at 4 standard errors (wrongly refused in 6 of 100,000 tests).
    testing::AssertionResult tells_the_truth() const {
        const double error = std::hypot(measured.standard_error(), told.standard_error()) / measured.mean();
        const double ratio = told.mean() / measured.mean();
        const testing::AssertionResult verdict = std::abs(ratio - 1) < 4 * error && 4 * error < 0.05
                                                     ? testing::AssertionSuccess()
                                                     : testing::AssertionFailure();
        return testing::AssertionResult(verdict) << ratio << " of the truth, standard error " << error;
    }
};

TEST(Merge, VarianceIsThatOfTheMergedMean) {
    // 20 merges of 64 x 64 pixels; the variances of a sample are 19 and 1/3.
    const Deviations mixed(64, 20, {{8, rare}, {16, rare}, {4, ordinary}}, 3);
    EXPECT_TRUE(mixed.tells_the_truth());
    EXPECT_NEAR(mixed.worth, 19 * 3, 0.1 * 19 * 3);
    const double best = 1 / (24 / 19.0 + 4 / (1 / 3.0));
    EXPECT_NEAR(mixed.measured.mean() / best, 1, 0.03);
}

TEST(Merge, PicturesAlikeCountAlike) {
    // By their measured variances alone, pictures of few pixels and rare bright samples would count very differently.
    const Deviations alike(8, 2000, {{16, rare}, {16, rare}, {16, rare}, {16, rare}}, 4);
    EXPECT_TRUE(alike.tells_the_truth());
    EXPECT_NEAR(alike.measured.mean() / (19.0 / 64), 1, 0.05);
}

TEST(Merge, OneSampleAPixelCountsAsOne) {
    // No picture knows its variance: the scatter between them tells it.
    const Deviations single(64, 20, {{1, ordinary}, {1, ordinary}, {1, ordinary}, {1, ordinary}}, 5);
    EXPECT_TRUE(single.tells_the_truth());
    EXPECT_NEAR(single.told.mean(), 1.0 / 3 / 4, 0.01 / 3 / 4);
    // Beside others that know theirs, it is taken from them.
    const Deviations one(64, 20, {{8, ordinary}, {1, ordinary}}, 6);
    EXPECT_TRUE(one.tells_the_truth());
    EXPECT_NEAR(one.worth, 1, 1e-9);
}

/// One row of pixels that all have the same value and number of samples.
Picture even(int width, float value, float samples, float variance) {
    const auto pixels = static_cast<std::size_t>(width);
    Picture picture;
    picture.image = Image(width, 1, Rgb(value));
    picture.full_size = {width, 1};
    picture.layers = {{"depth", {"Z"}, std::vector<float>(pixels, value)},
                      {"samples", {"N"}, std::vector<float>(pixels, samples)},
                      {"variance", {"R", "G", "B"}, std::vector<float>(3 * pixels, variance)}};
    return picture;
}

TEST(Merge, LayersAreMeansOverSamples) {
    const Picture a = even(4, 1, 16, 0.5f), b = even(4, 3, 48, 0.5f / 3);
    const MergedPictures merged = merge({a, b});
    EXPECT_NEAR(merged.picture.image.at(2, 0).r, 2.5, 1e-6);
    EXPECT_NEAR(merged.shares[1], 0.75, 1e-6);
    EXPECT_EQ(values(merged.picture, "samples"), std::vector<float>(4, 64));
    EXPECT_NEAR(values(merged.picture, "depth")[3], 2.5, 1e-6);
    EXPECT_NEAR(values(merged.picture, "variance")[11], 0.125, 1e-6);
    EXPECT_EQ(merged.picture.layers.size(), 3u);
    EXPECT_TRUE(merged.left_out.empty());
    EXPECT_EQ(merged.empty, 0u);
}

TEST(Merge, PartsAddUpToTheMergedPicture) {
    // Of unlike noise, so that samples do not count alike.
    Pcg32 random(5);
    std::vector<Picture> pictures;
    for (const Noise noise : {ordinary, rare}) {
        Picture& picture = pictures.emplace_back(noisy(16, 32, noise, random));
        Layer direct{"direct", {"R", "G", "B"}, {}}, light{"light_key", {"R", "G", "B"}, {}};
        for (std::size_t i = 0; i < 3 * picture.image.pixels.size(); ++i) {
            const float part = random.uniform() * picture.image.pixels[i / 3].r;
            direct.values.push_back(part);
            light.values.push_back(picture.image.pixels[i / 3].r - part);
        }
        picture.layers.push_back(std::move(direct));
        picture.layers.push_back(std::move(light));
    }
    const Picture merged = merge_pictures(2, [&](std::size_t k) { return pictures[k]; }).picture;
    const auto values = [](const Picture& picture, const char* name) {
        return std::find_if(picture.layers.begin(), picture.layers.end(),
                            [&](const Layer& l) { return l.name == name; })
            ->values;
    };
    double by_samples = 0;
    for (std::size_t i = 0; i < 3 * merged.image.pixels.size(); ++i) {
        const float beauty = merged.image.pixels[i / 3].r;
        EXPECT_NEAR(values(merged, "direct")[i] + values(merged, "light_key")[i], beauty, 4 * 0x1p-24f * beauty);
        const float mean = 0.5f * (values(pictures[0], "direct")[i] + values(pictures[1], "direct")[i]);
        by_samples = std::max(by_samples, static_cast<double>(std::abs(values(merged, "direct")[i] - mean)));
    }
    EXPECT_GT(by_samples, 0.1) << "means over samples would do as well";
}

TEST(Merge, ObjectsAreCountedEachForItself) {
    const auto with_objects = [](int samples, std::vector<Coverage> seen) {
        Pcg32 random(7);
        Picture picture = noisy(1, samples, ordinary, random);
        PixelCoverage pixel;
        for (const Coverage& object : seen) {
            pixel.add(object);
        }
        for (Layer& layer : cryptomatte_layers({pixel}, {1})) {
            picture.layers.push_back(std::move(layer));
        }
        return picture;
    };
    const std::vector<Picture> pictures = {with_objects(12, {{21, 0.75f}, {22, 0.25f}}), with_objects(4, {{22, 1}})};
    const Picture merged = merge_pictures(2, [&](std::size_t k) { return pictures[k]; }).picture;
    PixelCoverage objects;
    for (const Layer& layer : merged.layers) {
        if (is_cryptomatte(layer)) {
            add_coverage(layer, 0, 1, objects);
        }
    }
    ASSERT_EQ(objects.objects().size(), 2u);
    EXPECT_EQ(objects.objects()[0].id, 21u);
    EXPECT_FLOAT_EQ(objects.objects()[0].part, 0.75f * 0.75f);
    EXPECT_EQ(objects.objects()[1].id, 22u);
    EXPECT_FLOAT_EQ(objects.objects()[1].part, 0.75f * 0.25f + 0.25f);
}

TEST(Merge, PicturesCountNothingWhereTheyHaveNoSamples) {
    Picture a = even(4, 1, 16, 0.5f), b = even(4, 3, 16, 0.5f);
    for (const auto& [picture, pixel] : {std::pair{&a, 0}, {&b, 1}, {&a, 3}, {&b, 3}}) {
        const auto i = static_cast<std::size_t>(pixel);
        picture->image.pixels[i] = Rgb(0);
        layer(*picture, "samples").values[i] = 0;
        layer(*picture, "depth").values[i] = std::numeric_limits<float>::quiet_NaN();
    }
    const MergedPictures merged = merge({a, b});
    EXPECT_NEAR(merged.picture.image.at(0, 0).r, 3, 1e-6);
    EXPECT_NEAR(merged.picture.image.at(1, 0).r, 1, 1e-6);
    EXPECT_NEAR(merged.picture.image.at(2, 0).r, 2, 1e-6);
    EXPECT_EQ(merged.picture.image.at(3, 0), Rgb(0));
    EXPECT_NEAR(values(merged.picture, "depth")[0], 3, 1e-6);
    EXPECT_EQ(values(merged.picture, "depth")[3], 0);
    EXPECT_EQ(values(merged.picture, "samples"), (std::vector<float>{16, 16, 32, 0}));
    EXPECT_EQ(merged.empty, 1u);
}

TEST(Merge, NumbersTooLargeForTheirVarianceDoNoHarm) {
    Picture a = even(4, 1, 16, 0.5f);
    layer(a, "variance").values[0] = std::numeric_limits<float>::infinity();
    for (const Rgb& pixel : merge({a, even(4, 3, 16, 0.5f)}).picture.image.pixels) {
        EXPECT_NEAR(pixel.r, 2, 1e-6);
    }
}

TEST(Merge, PicturesWithoutNoiseCountByTheirSamples) {
    EXPECT_NEAR(merge({even(1, 1, 1, 0), even(1, 5, 3, 0)}).picture.image.at(0, 0).r, 4, 1e-6);
    EXPECT_EQ(merge({even(3, 0, 4, 0), even(3, 0, 4, 0)}).picture.image.at(1, 0), Rgb(0));
}

TEST(Merge, LayersThatNotAllHaveAreLeftOut) {
    Picture a = even(4, 1, 16, 0.5f), b = a, c = a;
    a.layers.push_back({"own", {"A"}, std::vector<float>(4, 1)});
    c.layers.push_back({"", {"A"}, std::vector<float>(4, 1)});
    const MergedPictures merged = merge({a, b, c});
    EXPECT_EQ(merged.left_out, (std::vector<std::string>{"own", ""}));
    EXPECT_EQ(merged.picture.layers.size(), 3u);
}

TEST(Merge, RefusesWhatCannotBeMerged) {
    const Picture good = even(4, 1, 16, 0.5f);
    const auto expect_refused = [&](const std::function<void(Picture&)>& spoil, const std::string& part) {
        Picture bad = good;
        spoil(bad);
        try {
            merge({good, bad});
            ADD_FAILURE() << part;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(part), std::string::npos) << error.what();
        }
    };
    const float nan = std::numeric_limits<float>::quiet_NaN();
    expect_refused([](Picture& p) { p.layers.pop_back(); }, "'variance'");
    expect_refused([](Picture& p) { layer(p, "samples").name = "counts"; }, "'samples'");
    expect_refused([](Picture& p) { layer(p, "variance").channels = {"X", "Y", "Z"}; }, "'variance'");
    expect_refused([](Picture& p) { layer(p, "depth").channels = {"N"}; }, "'depth'");
    expect_refused([](Picture& p) { layer(p, "samples").values[1] = -1; }, "number of samples");
    expect_refused([](Picture& p) { layer(p, "samples").values[1] = 1.5f; }, "number of samples");
    expect_refused([&](Picture& p) { layer(p, "samples").values[1] = nan; }, "number of samples");
    expect_refused([](Picture& p) { layer(p, "variance").values[1] = -1; }, "negative");
    expect_refused([&](Picture& p) { layer(p, "variance").values[1] = nan; }, "not numbers");
    expect_refused([&](Picture& p) { p.image.pixels[2].b = nan; }, "finite");
    expect_refused([](Picture& p) { p.offset.x = 1; }, "pixels 1 to 5");
    expect_refused([](Picture& p) { p.full_size.y = 2; }, "4 x 2");
    expect_refused([](Picture& p) { p = even(5, 1, 16, 0.5f); }, "pixels 0 to 5");
}

}  // namespace
}  // namespace wend
