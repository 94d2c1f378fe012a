#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/film/metrics.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numeric>
#include <string>
#include <vector>

namespace wend {
namespace {

Reference single(const Image& image) {
    return {image, image};
}

/// The message of the InputError that measuring throws; empty if none.
std::string complaint(const Image& image, const Reference& reference) {
    try {
        measure(image, reference);
    } catch (const InputError& error) {
        return error.what();
    }
    return {};
}

TEST(Metrics, IdenticalPicturesHaveNoError) {
    const Image image(40, 30, {0.5f, 1, 2});
    const Metrics metrics = measure(image, single(image));
    EXPECT_EQ(metrics.relmse, 0);
    EXPECT_EQ(metrics.relmse_std_error, 0);
    EXPECT_EQ(metrics.relmse_trimmed, 0);
    EXPECT_EQ(metrics.error_p9999, 0);
    EXPECT_EQ(metrics.mse, 0);
    EXPECT_EQ(metrics.mape, 0);
}

TEST(Metrics, MatchesAHandComputedExample) {
    // Two grey pixels, R = 1 and 3: mean(R) = 2, e = 0.04.
    Image reference(2, 1), image(2, 1);
    reference.pixels = {Rgb(1), Rgb(3)};
    image.pixels = {Rgb(1.5f), Rgb(2)};
    const Metrics metrics = measure(image, single(reference));
    const double first = 0.25 / 1.04, second = 1 / 9.04;
    EXPECT_NEAR(metrics.relmse, (first + second) / 2, 1e-7);
    EXPECT_NEAR(metrics.relmse_std_error, std::abs(first - second) / 2, 1e-7);
    EXPECT_NEAR(metrics.mse, (0.25 + 1) / 2, 1e-7);
    EXPECT_NEAR(metrics.mape, (0.5 / 1.02 + 1 / 3.02) / 2, 1e-7);
}

TEST(Metrics, ChannelsCountApartAndHalvesMultiply) {
    // One pixel: R = (a + b) / 2 = (1, 2, 3), mean(R) = 2, e = 0.04.
    const Image image(1, 1, {2, 2, 2});
    const Reference reference{Image(1, 1, {0, 2, 4}), Image(1, 1, {2, 2, 2})};
    const Metrics metrics = measure(image, reference);
    // (I − a)(I − b) is zero in every channel, though neither half equals the image.
    EXPECT_EQ(metrics.relmse, 0);
    const Metrics dark = measure(Image(1, 1), reference);
    EXPECT_NEAR(dark.relmse, (0 / 1.04 + 4 / 4.04 + 8 / 9.04) / 3, 1e-7);
    EXPECT_NEAR(dark.mse, 4, 1e-6);
}

TEST(Metrics, FireflyErrorIsThe9999thOfTenThousand) {
    // Against a grey reference of 1, e = 0.01: 57600 pixels are off by 0.1, and six of them by much more.
    constexpr int width = 320, height = 180;
    const Image reference(width, height, Rgb(1));
    Image image(width, height, Rgb(1.1f));
    for (int i = 0; i < 6; ++i) {
        image.pixels[static_cast<std::size_t>(997 * i)] = Rgb(11.0f + static_cast<float>(i));
    }
    const auto error = [](double difference) { return difference * difference / 1.01; };
    // Of 57600, five may exceed it.
    EXPECT_NEAR(measure(image, single(reference)).error_p9999, error(10), 1e-4 * error(10));
    image.pixels[0] = Rgb(1.1f);
    EXPECT_NEAR(measure(image, single(reference)).error_p9999, error(0.1), 1e-4 * error(0.1));

    std::vector<float> pooled(20000);
    std::iota(pooled.begin(), pooled.end(), 1.0f);
    EXPECT_EQ(firefly_error(pooled), 19998);
    EXPECT_EQ(firefly_error({3, 7, 5}), 7);
    EXPECT_EQ(firefly_error({}), 0);
}

TEST(Metrics, ErrorMapAveragesToRelmse) {
    Image reference(7, 5), image(7, 5);
    Pcg32 rng(1);
    for (std::size_t i = 0; i < image.pixels.size(); ++i) {
        reference.pixels[i] = Rgb(0.1f + rng.uniform(), rng.uniform(), 2 * rng.uniform());
        image.pixels[i] = Rgb(rng.uniform(), rng.uniform(), rng.uniform());
    }
    const std::vector<float> map = relative_squared_errors(image, single(reference));
    ASSERT_EQ(map.size(), 35u);
    EXPECT_NEAR(std::accumulate(map.begin(), map.end(), 0.0) / 35, measure(image, single(reference)).relmse, 1e-6);
}

TEST(Metrics, TrimmingDropsTheWorstThousandth) {
    const Image reference(50, 40, Rgb(1));
    Image image(50, 40, Rgb(1.1f));
    image.at(3, 7) = Rgb(1000);
    image.at(49, 39) = Rgb(500);
    const Metrics two_fireflies = measure(image, single(reference));
    EXPECT_GT(two_fireflies.relmse, 500);
    EXPECT_NEAR(two_fireflies.relmse_trimmed, 0.01 / 1.01, 1e-6);

    image.at(0, 0) = Rgb(200);
    EXPECT_GT(measure(image, single(reference)).relmse_trimmed, 10) << "a third firefly is beyond 0.1 % of 2000 pixels";
}

/// Repeated measurements of one fixed picture against fresh noisy references.
struct Trials {
    double mean = 0;
    double std_error = 0;

    template <class Measurement>
    Trials(int count, Measurement&& measurement) {
        double sum = 0, squares = 0;
        for (int trial = 0; trial < count; ++trial) {
            const double value = measurement(trial);
            sum += value;
            squares += value * value;
        }
        mean = sum / count;
        std_error = std::sqrt((squares / count - mean * mean) / (count - 1));
    }
};

class NoisyReference : public testing::Test {
protected:
    static constexpr float noise = 0.03f;
    static constexpr int trials = 64;

    Image truth{32, 32};
    Image image{32, 32};

    void SetUp() override {
        for (std::size_t i = 0; i < truth.pixels.size(); ++i) {
            const float level = 0.5f + static_cast<float>(i % 32) / 32;
            truth.pixels[i] = {level, 1.5f - level / 2, 1};
        }
        image = with_noise(truth, 12345);
    }

    /// `image` plus noise of mean 0 and standard deviation `noise` (uniform).
    static Image with_noise(Image image, std::uint64_t key) {
        Pcg32 rng(key);
        const auto draw = [&] { return noise * std::sqrt(12.0f) * (rng.uniform() - 0.5f); };
        for (Rgb& pixel : image.pixels) {
            pixel += Rgb(draw(), draw(), draw());
        }
        return image;
    }

    /// A half of the reference of a trial.
    Image half(int trial, int which) const { return with_noise(truth, hash_of(trial, which)); }
};

TEST_F(NoisyReference, TwoHalvesEstimateTheNoiseFreeError) {
    const Metrics exact = measure(image, single(truth));
    const auto measured = [&](int trial) { return measure(image, {half(trial, 0), half(trial, 1)}); };
    const Trials relmse(trials, [&](int trial) { return measured(trial).relmse; });
    const Trials mse(trials, [&](int trial) { return measured(trial).mse; });
    EXPECT_NEAR(relmse.mean, exact.relmse, 3 * relmse.std_error);
    EXPECT_NEAR(mse.mean, exact.mse, 3 * mse.std_error);
    EXPECT_LT(relmse.std_error, 0.02 * exact.relmse) << "the test must be able to see a bias";
}

TEST_F(NoisyReference, OneHalfUsedTwiceIsBiased) {
    const Metrics exact = measure(image, single(truth));
    const Trials relmse(trials, [&](int trial) { return measure(image, single(half(trial, 0))).relmse; });
    const Trials mse(trials, [&](int trial) { return measure(image, single(half(trial, 0))).mse; });
    EXPECT_GT(relmse.mean, exact.relmse + 10 * relmse.std_error);
    EXPECT_GT(mse.mean, exact.mse + 10 * mse.std_error);
}

TEST_F(NoisyReference, StandardErrorPredictsTheScatter) {
    // Fresh pictures against the exact reference: their relMSE scatters as the estimated standard error says.
    const Trials relmse(trials,
                        [&](int trial) { return measure(with_noise(truth, hash_of(trial, 2)), single(truth)).relmse; });
    const double scatter = relmse.std_error * std::sqrt(static_cast<double>(trials));
    EXPECT_NEAR(measure(image, single(truth)).relmse_std_error / scatter, 1, 0.3);
}

TEST(Metrics, RefusesWhatCannotBeCompared) {
    const Image good(4, 3, Rgb(1));
    EXPECT_EQ(complaint(good, single(good)), "");
    EXPECT_EQ(complaint(Image(5, 3, Rgb(1)), single(good)),
              "the image is 5x3 pixels but the reference (half a) is 4x3");
    EXPECT_EQ(complaint(good, {good, Image(4, 4, Rgb(1))}),
              "the image is 4x3 pixels but the reference (half b) is 4x4");
    EXPECT_EQ(complaint(Image(), single(Image())), "the image has no pixels");
    EXPECT_NE(complaint(good, single(Image(4, 3))).find("black"), std::string::npos);

    Image broken = good;
    broken.at(2, 1).g = std::numeric_limits<float>::quiet_NaN();
    broken.at(3, 2).g = std::numeric_limits<float>::infinity();
    EXPECT_EQ(complaint(broken, single(good)), "the image is not finite at pixel (2, 1)");
    EXPECT_EQ(complaint(good, {good, broken}), "the reference (half b) is not finite at pixel (2, 1)");
    EXPECT_THROW(relative_squared_errors(broken, single(good)), InputError);
}

TEST(Metrics, HugeValuesStayFinite) {
    const Image bright(2, 2, Rgb(3e38f)), dim(2, 2, Rgb(1e-10f));
    for (const float value : relative_squared_errors(bright, single(dim))) {
        EXPECT_TRUE(std::isfinite(value));
    }
    EXPECT_NEAR(measure(dim, single(bright)).relmse, 1 / 1.01, 1e-6);
}

}  // namespace
}  // namespace wend
