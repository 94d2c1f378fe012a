#include <wend/core/random.h>
#include <wend/film/error_terms.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>

namespace wend {
namespace {

/// Grey of 1 and colours around it, each channel off by noise of this standard deviation.
Image noisy(std::uint64_t key, float noise) {
    Image image(48, 48);
    Pcg32 random(key);
    const auto draw = [&] { return noise * std::sqrt(12.0f) * (random.uniform() - 0.5f); };
    for (Rgb& pixel : image.pixels) {
        pixel = Rgb(1 + draw(), 2 + draw(), 0.5f + draw());
    }
    return image;
}

double mean(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(ErrorTerms, AreWhatTheMeasuresAreMeansOf) {
    const Reference reference{noisy(1, 0.1f), noisy(2, 0.1f)};
    const Image image = noisy(3, 0.3f);
    const ErrorTerms terms = error_terms(image, reference);
    const Metrics metrics = measure(image, reference);
    EXPECT_NEAR(mean(terms.relative_squared), metrics.relmse, 1e-12);
    EXPECT_NEAR(mean(terms.relative), metrics.mape, 1e-12);
    EXPECT_NEAR(mean(terms.squared), metrics.mse, 1e-12);
    ASSERT_EQ(terms.difference.size(), 3 * image.pixels.size());
    EXPECT_NEAR(terms.difference[4], image.pixels[1].g - reference.average().pixels[1].g, 1e-6);
}

TEST(ErrorTerms, MeansAreOverAllPictures) {
    const Reference reference{noisy(1, 0.1f), noisy(2, 0.1f)};
    MeanErrors errors;
    double relmse = 0;
    for (const std::uint64_t key : {3, 4, 5}) {
        errors.add(error_terms(noisy(key, 0.3f), reference));
        relmse += measure(noisy(key, 0.3f), reference).relmse / 3;
    }
    EXPECT_EQ(errors.count(), 3u);
    EXPECT_NEAR(mean(errors.mean().relative_squared), relmse, 1e-12);
    EXPECT_TRUE(MeanErrors().mean().squared.empty());
}

TEST(ErrorTerms, ANumberTooLargeForAFloatBecomesTheLargest) {
    const std::vector<float> floats = to_floats({1e300, -1e300, 0.5});
    EXPECT_EQ(floats[0], std::numeric_limits<float>::max());
    EXPECT_EQ(floats[1], -std::numeric_limits<float>::max());
    EXPECT_EQ(floats[2], 0.5f);
}

TEST(ReferenceNoise, IsTheErrorOfItsAverageThatTheHalvesTell) {
    const Reference reference{noisy(1, 0.02f), noisy(2, 0.02f)};
    const Image truth = noisy(0, 0);
    // 6912 numbers tell a variance to about 2 %.
    const double error = measure(reference.average(), {truth, truth}).relmse;
    ASSERT_TRUE(noise_of(reference));
    EXPECT_NEAR(*noise_of(reference) / error, 1, 0.06);
    // The noise of denominators is a hundredth of that.
    const Reference twice{noisy(1, 0.04f), noisy(2, 0.04f)};
    EXPECT_NEAR(*noise_of(twice) / *noise_of(reference), 4, 0.1);
    EXPECT_FALSE(noise_of({truth, truth})) << "one picture does not know its noise";
}

}  // namespace
}  // namespace wend
