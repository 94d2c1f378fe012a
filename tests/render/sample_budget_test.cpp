// Samples where the noise is: pixels get them by their noise, and their means stay right.
#include <wend/stats/significance.h>

#include <wend/core/random.h>
#include <wend/film/film.h>
#include <wend/render/sample_budget.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <numeric>

namespace wend {
namespace {

constexpr int budget_side = 32;

double sum_of(const std::vector<std::uint32_t>& counts) {
    return std::accumulate(counts.begin(), counts.end(), 0.0);
}

/// Noise of a picture of which the right half varies that much more, after so many samples.
std::vector<PixelNoise> noise_of_halves(double right, double samples) {
    std::vector<PixelNoise> noise(budget_side * budget_side);
    for (std::size_t i = 0; i < noise.size(); ++i) {
        noise[i] = {i % budget_side < budget_side / 2 ? 1.0 : right, samples, 4, static_cast<std::uint32_t>(samples)};
    }
    return noise;
}

/// Samples of a pixel in columns from one on, as a mean.
double mean_of_columns(const std::vector<std::uint32_t>& counts, std::size_t first, std::size_t last) {
    double sum = 0;
    for (std::size_t i = 0; i < counts.size(); ++i) {
        sum += i % budget_side >= first && i % budget_side < last ? counts[i] : 0;
    }
    return sum / (budget_side * static_cast<double>(last - first));
}

TEST(SampleBudget, GoesWhereTheNoiseIs) {
    const auto even = sample_counts(noise_of_halves(1, 7), budget_side, 8, 1);
    EXPECT_GE(*std::min_element(even.begin(), even.end()), 7u) << "of one noise all have as many";
    EXPECT_LE(*std::max_element(even.begin(), even.end()), 9u);
    EXPECT_NEAR(sum_of(even) / (budget_side * budget_side), 8, 0.01);
    // In the end samples are as the roots of the variances: 7 + 25 to (7 + 25) / 2 far from the border.
    const auto counts = sample_counts(noise_of_halves(4, 7), budget_side, 17, 1);
    EXPECT_NEAR(sum_of(counts) / (budget_side * budget_side), 17, 0.1);
    EXPECT_NEAR((mean_of_columns(counts, 22, 32) + 7) / (mean_of_columns(counts, 0, 10) + 7), 2, 0.15);
    // What has been done already counts.
    auto done = noise_of_halves(4, 7);
    for (std::size_t i = 0; i < done.size(); ++i) {
        done[i].samples = i % budget_side < budget_side / 2 ? 16 : 32;
    }
    const auto few = sample_counts(done, budget_side, 8, 1);
    EXPECT_NEAR((mean_of_columns(few, 22, 32) + 32) / (mean_of_columns(few, 0, 10) + 16), 2, 0.15);
}

TEST(SampleBudget, DearSamplesAreFewer) {
    std::vector<PixelNoise> noise = noise_of_halves(1, 7);
    for (std::size_t i = 0; i < noise.size(); ++i) {
        noise[i].work = i % budget_side < budget_side / 2 ? 3 : 15;
    }
    const auto counts = sample_counts(noise, budget_side, 64, 1);
    EXPECT_NEAR((mean_of_columns(counts, 0, 10) + 7) / (mean_of_columns(counts, 22, 32) + 7), 2, 0.15);
}

TEST(SampleBudget, KnowsNothingOfDarkAndOddPictures) {
    for (const double variance : {0.0, 1.0}) {
        for (const int width : {1, 2, 7}) {
            std::vector<PixelNoise> noise(static_cast<std::size_t>(width) * 3);
            for (PixelNoise& pixel : noise) {
                pixel = {variance, 7, variance, 7};
            }
            EXPECT_NEAR(sum_of(sample_counts(noise, width, 4, 1)), 12 * width, 2 * width) << width;
        }
    }
}

/// A sample of a pixel whose mean is 1: mostly dark, seldom bright, here more seldom than there.
FilmSample seldom_bright(std::size_t pixel, Pcg32& random) {
    const float chance = pixel % budget_side < budget_side / 2 ? 0.5f : 0.125f;
    FilmSample sample;
    sample.radiance = Rgb(random.uniform() < chance ? 1 / chance : 0.0f);
    sample.segments = 2;
    return sample;
}

using BudgetOfNoise = std::function<std::vector<std::uint32_t>(const std::vector<PixelNoise>&, std::uint64_t seed)>;

/// The mean of many pictures that are made in passes.
Moments means_of_pictures(const BudgetOfNoise& budget) {
    constexpr int pictures = 600, passes = 5;
    Moments means;
    for (int i = 0; i < pictures; ++i) {
        Pcg32 random(hash_of(i));
        Film film({budget_side, budget_side}, {{0, 0}, {budget_side, budget_side}});
        for (int pass = 0; pass < passes; ++pass) {
            const std::vector<std::uint32_t> counts = pass == 0
                                                          ? std::vector<std::uint32_t>(budget_side * budget_side, 7)
                                                          : budget(film.noise(), hash_of(i, pass));
            for (std::size_t pixel = 0; pixel < counts.size(); ++pixel) {
                const Vec2i place(static_cast<int>(pixel) % budget_side, static_cast<int>(pixel) / budget_side);
                for (std::uint32_t k = 0; k < counts[pixel]; ++k) {
                    film.add(place, seldom_bright(pixel, random));
                }
            }
        }
        const Image image = film.beauty();
        means.add(std::accumulate(image.pixels.begin(), image.pixels.end(), 0.0,
                                  [](double sum, const Rgb& p) { return sum + static_cast<double>(p.r); }) /
                  (budget_side * budget_side));
    }
    return means;
}

// 600 pictures of 1,024 pixels and about 27 samples: the standard error is some 0.0004.
TEST(SampleBudgetSlow, LeavesMeansRightToATenthOfAPercent) {
    const auto means = means_of_pictures([](const std::vector<PixelNoise>& noise, std::uint64_t seed) {
        return sample_counts(noise, budget_side, 5, seed);
    });
    EXPECT_LT(means.standard_error(), 0.0005);
    EXPECT_TRUE(agrees(means, 1.0, 3)) << means.mean();
}

// Its negative twin: a pixel's own samples say how many follow.
TEST(SampleBudgetSlow, WouldDarkenPicturesThatJudgeThemselves) {
    const auto means = means_of_pictures([](const std::vector<PixelNoise>& noise, std::uint64_t) {
        std::vector<std::uint32_t> counts;
        for (const PixelNoise& pixel : noise) {
            counts.push_back(
                static_cast<std::uint32_t>(std::lround(std::clamp(3 * std::sqrt(pixel.variance), 1.0, 20.0))));
        }
        return counts;
    });
    EXPECT_FALSE(agrees(means, 1.0, 3)) << means.mean();
    EXPECT_GT(std::abs(means.mean() - 1), 0.01);
}

}  // namespace
}  // namespace wend
