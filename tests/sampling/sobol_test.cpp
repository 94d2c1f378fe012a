#include <wend/sampling/sobol.h>

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <utility>

namespace wend {
namespace {

/// The second coordinate by its direction numbers: v_0 = 1/2, v_k = v_{k-1} xor v_{k-1} >> 1.
std::uint32_t second_coordinate(std::uint32_t index) {
    std::uint32_t x = 0;
    for (std::uint32_t v = 0x80000000u; index != 0; index >>= 1, v ^= v >> 1) {
        x ^= (index & 1) ? v : 0;
    }
    return x;
}

TEST(Sobol, FirstPointsAreTheKnownOnes) {
    const float expected[8][2] = {{0, 0},           {0.5f, 0.5f},     {0.25f, 0.75f},   {0.75f, 0.25f},
                                  {0.125f, 0.625f}, {0.625f, 0.125f}, {0.375f, 0.375f}, {0.875f, 0.875f}};
    for (std::uint32_t i = 0; i < 8; ++i) {
        const auto p = sobol_reversed(i);
        EXPECT_EQ(to_unit_float(reverse_bits(p[0])), expected[i][0]) << i;
        EXPECT_EQ(to_unit_float(reverse_bits(p[1])), expected[i][1]) << i;
    }
}

TEST(Sobol, ButterfliesAreTheDirectionNumbers) {
    for (std::uint32_t i = 0; i < 100000; ++i) {
        const std::uint32_t index = i < 50000 ? i : i * 0x9e3779b1u;
        ASSERT_EQ(reverse_bits(sobol_reversed(index)[1]), second_coordinate(index)) << index;
        ASSERT_EQ(sobol_reversed(index)[0], index);
    }
}

/// Whether 2^m points have exactly one in each elementary interval of volume 2^-m, of all m + 1 shapes.
template <class Point>
bool is_net(int m, const Point& point) {
    const std::uint32_t n = 1u << m;
    for (int k = 0; k <= m; ++k) {
        std::set<std::pair<int, int>> cells;
        for (std::uint32_t i = 0; i < n; ++i) {
            const Vec2 p = point(i);
            cells.emplace(static_cast<int>(std::ldexp(p.x, k)), static_cast<int>(std::ldexp(p.y, m - k)));
        }
        if (cells.size() != n) {
            return false;
        }
    }
    return true;
}

TEST(OwenSobol, EveryPowerOfTwoIsANet) {
    for (std::uint64_t key = 1; key <= 20; ++key) {
        for (int m = 0; m <= 10; ++m) {
            EXPECT_TRUE(is_net(m, [&](std::uint32_t i) { return owen_sobol(i, mix(key)); })) << key << ", 2^" << m;
        }
    }
}

TEST(OwenSobol, EveryAlignedBlockIsANet) {
    for (const std::uint32_t block : {1u, 5u, 1000u}) {
        EXPECT_TRUE(is_net(6, [&](std::uint32_t i) { return owen_sobol(block * 64 + i, mix(3)); }));
    }
}

TEST(OwenSobol, IndependentPointsAreNoNet) {
    Pcg32 random(1);
    EXPECT_FALSE(is_net(6, [&](std::uint32_t) { return random.uniform2(); }));
}

/// Correlation of the same coordinate of two sequences over 4096 points.
double correlation(std::uint64_t key_a, std::uint64_t key_b, int dimension_a, int dimension_b) {
    constexpr int n = 4096;
    double sum = 0;
    for (std::uint32_t i = 0; i < n; ++i) {
        const Vec2 a = owen_sobol(i, key_a), b = owen_sobol(i, key_b);
        sum += (a[dimension_a] - 0.5) * (b[dimension_b] - 0.5);
    }
    return 12 * sum / n;
}

TEST(OwenSobol, DifferentKeysAreUncorrelated) {
    // Correlations of independent points would have a standard deviation of 1/64.
    for (std::uint64_t key = 0; key < 50; ++key) {
        for (const auto& [a, b] : {std::pair{0, 0}, {0, 1}, {1, 1}}) {
            EXPECT_LT(std::abs(correlation(mix(key), mix(key + 1), a, b)), 5.0 / 64) << key;
        }
    }
    EXPECT_NEAR(correlation(mix(1), mix(1), 0, 0), 1, 1e-2);
}

}  // namespace
}  // namespace wend
