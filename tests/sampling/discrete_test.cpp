#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>
#include <wend/sampling/discrete.h>

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <vector>

namespace wend {
namespace {

std::vector<float> random_weights(int n, std::uint64_t seed) {
    Pcg32 random(seed);
    std::vector<float> weights;
    for (int i = 0; i < n; ++i) {
        const float u = random.uniform();
        weights.push_back(u < 0.2f ? 0.0f : u * u * u * 1e3f);
    }
    return weights;
}

double p_value_of(const AliasTable& table, const std::vector<float>& weights) {
    constexpr int samples = 200000;
    std::vector<std::uint64_t> observed(weights.size());
    Pcg32 random(3);
    for (int i = 0; i < samples; ++i) {
        ++observed[static_cast<std::size_t>(table.sample(random.uniform()))];
    }
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    std::vector<double> expected;
    for (const float w : weights) {
        expected.push_back(samples * w / total);
    }
    return chi_square_test(observed, expected).p_value;
}

TEST(Select, SplitsTheUnitIntervalInProportion) {
    const std::array<float, 5> weights = {0, 1, 0, 3, 0};
    for (int i = 0; i < 100; ++i) {
        const float u = (static_cast<float>(i) + 0.5f) / 100;
        float rest = u;
        const int chosen = select(weights, 4, rest);
        EXPECT_EQ(chosen, i < 25 ? 1 : 3);
        EXPECT_NEAR(rest, i < 25 ? 4 * u : (u - 0.25f) * 4 / 3, 1e-5);
    }
}

TEST(Select, RoundingSelectsNoZeroWeight) {
    const std::array<float, 3> weights = {0, 0.3f, 0};
    for (const float total : {0.3f, 0.30001f}) {
        for (const float start : {0.0f, one_minus_epsilon}) {
            float u = start;
            EXPECT_EQ(select(weights, total, u), 1);
            EXPECT_LT(u, 1);
        }
    }
}

TEST(AliasTable, FrequenciesFollowTheWeights) {
    for (const int n : {2, 3, 17, 256}) {
        const std::vector<float> weights = random_weights(n, static_cast<std::uint64_t>(n));
        EXPECT_GE(p_value_of(AliasTable(weights), weights), test::passing) << n << " weights";
    }
}

TEST(AliasTable, OneWeightSlightlyWrongIsRejected) {
    std::vector<float> weights = {1, 2, 3, 4};
    const AliasTable table(weights);
    weights[1] *= 1.05f;
    EXPECT_LT(p_value_of(table, weights), test::failing);
}

TEST(AliasTable, ProbabilitiesAreNormalizedWeights) {
    const std::vector<float> weights = random_weights(100, 5);
    const AliasTable table(weights);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    for (int i = 0; i < table.size(); ++i) {
        EXPECT_NEAR(table.probability(i), weights[static_cast<std::size_t>(i)] / total, 1e-7);
    }
}

TEST(AliasTable, NeverDrawsTheImpossible) {
    const std::vector<float> weights = {0, 1, 0, 0, 1e-20f, 3, 0};
    const AliasTable table(weights);
    for (int i = 0; i <= 7000; ++i) {
        const float u = std::min(static_cast<float>(i) / 7000, one_minus_epsilon);
        EXPECT_GT(table.probability(table.sample(u)), 0) << u;
    }
}

TEST(AliasTable, AllZeroMeansUniform) {
    const std::vector<float> zero(4, 0.0f);
    const AliasTable table(zero);
    EXPECT_EQ(table.probability(2), 0.25f);
    EXPECT_EQ(table.sample(0.6f), 2);
}

constexpr int width = 7, height = 5;

TEST(PiecewiseConstant, DensityIntegratesToOneAndFollowsTheWeights) {
    const std::vector<float> weights = random_weights(width * height, 7);
    const PiecewiseConstant2D distribution(weights, width, height);
    const double total = std::accumulate(weights.begin(), weights.end(), 0.0);
    double sum = 0;
    for (int y = 0; y < height; ++y) {
        for (int x = 0; x < width; ++x) {
            const float density = distribution.density({(x + 0.3f) / width, (y + 0.8f) / height});
            EXPECT_NEAR(density, weights[static_cast<std::size_t>(y * width + x)] / total * width * height, 1e-5);
            sum += density / (width * height);
        }
    }
    EXPECT_NEAR(sum, 1, 1e-6);
}

/// Counts of samples against a density, over the cells each cut into 2 x 2.
double p_value_of(const PiecewiseConstant2D& samples_from, const PiecewiseConstant2D& density) {
    constexpr int samples = 300000, nx = 2 * width, ny = 2 * height;
    std::vector<std::uint64_t> observed(nx * ny);
    Pcg32 random(8);
    for (int i = 0; i < samples; ++i) {
        const Vec2 p = samples_from.sample(random.uniform2()).point;
        ++observed[static_cast<std::size_t>(static_cast<int>(p.y * ny) * nx + static_cast<int>(p.x * nx))];
    }
    std::vector<double> expected;
    for (int y = 0; y < ny; ++y) {
        for (int x = 0; x < nx; ++x) {
            expected.push_back(samples * density.density({(x + 0.5f) / nx, (y + 0.5f) / ny}) / (nx * ny));
        }
    }
    return chi_square_test(observed, expected).p_value;
}

TEST(PiecewiseConstant, SamplesFollowTheDensity) {
    const PiecewiseConstant2D distribution(random_weights(width * height, 7), width, height);
    EXPECT_GE(p_value_of(distribution, distribution), test::passing);
}

TEST(PiecewiseConstant, TransposedWeightsAreRejected) {
    const std::vector<float> weights = random_weights(width * height, 7);
    std::vector<float> transposed;
    for (int i = 0; i < width * height; ++i) {
        transposed.push_back(weights[static_cast<std::size_t>(i % height * width + i / height)]);
    }
    EXPECT_LT(p_value_of({weights, width, height}, {transposed, width, height}), test::failing);
}

TEST(PiecewiseConstant, SampleReportsTheDensityOfItsPoint) {
    const PiecewiseConstant2D distribution(random_weights(width * height, 7), width, height);
    Pcg32 random(9);
    for (int i = 0; i < 10000; ++i) {
        const auto s = distribution.sample(random.uniform2());
        EXPECT_GT(s.density, 0);
        EXPECT_FLOAT_EQ(s.density, distribution.density(s.point));
    }
}

TEST(PiecewiseConstant, AllZeroMeansUniform) {
    const std::vector<float> zero(6, 0.0f);
    const PiecewiseConstant2D distribution(zero, 3, 2);
    EXPECT_FLOAT_EQ(distribution.density({0.9f, 0.9f}), 1);
    EXPECT_NEAR(distribution.sample({0.4f, 0.7f}).point.x, 0.4f, 1e-6f);
}

}  // namespace
}  // namespace wend
