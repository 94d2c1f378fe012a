#include "verdicts.h"

#include <wend/core/random.h>
#include <wend/sampling/windowed.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <vector>

namespace wend {
namespace {

using Windowed = WindowedPiecewiseConstant2D;

/// 5 x 4 cells, some of weight 0.
Windowed uneven() {
    const std::vector<float> weights = {1, 0, 3, 2, 9, 0, 0, 1, 4, 1, 2, 5, 0, 7, 1, 3, 3, 8, 0, 2};
    return {weights, 5, 4};
}

const Windowed::Window window{{0.13f, 0.21f}, {0.77f, 0.9f}};

TEST(Windowed, DensityIntegratesToOne) {
    const Windowed distribution = uneven();
    constexpr int n = 1000;
    double sum = 0;
    for (int i = 0; i < n * n; ++i) {
        const Vec2 p((static_cast<float>(i % n) + 0.5f) / n, (static_cast<float>(i / n) + 0.5f) / n);
        sum += static_cast<double>(distribution.density(p, window)) / (n * n);
    }
    EXPECT_NEAR(sum, 1, 2e-3);
}

TEST(Windowed, SamplesFollowTheDensity) {
    const Windowed distribution = uneven();
    constexpr int samples = 100000, cells = 16, points = 40, all = cells * points;
    std::vector<std::uint64_t> observed(cells * cells);
    Pcg32 random(1);
    const Vec2 size = window.max - window.min;
    for (int i = 0; i < samples; ++i) {
        const auto s = distribution.sample(random.uniform2(), window);
        ASSERT_TRUE(s);
        ASSERT_TRUE(window.holds(s->point));
        EXPECT_EQ(s->density, distribution.density(s->point, window));
        const Vec2 at = (s->point - window.min) / size * cells;
        const int x = std::min(static_cast<int>(at.x), cells - 1), y = std::min(static_cast<int>(at.y), cells - 1);
        ++observed[static_cast<std::size_t>(y * cells + x)];
    }
    std::vector<double> expected(cells * cells), twin(cells * cells);
    for (int i = 0; i < all * all; ++i) {
        const int x = i % all, y = i / all;
        const Vec2 p =
            window.min + size * Vec2((static_cast<float>(x) + 0.5f) / all, (static_cast<float>(y) + 0.5f) / all);
        const double count = static_cast<double>(distribution.density(p, window) * size.x * size.y) * samples /
                             (static_cast<double>(all) * all);
        const auto cell = static_cast<std::size_t>(y / points * cells + x / points);
        expected[cell] += count;
        twin[cell] += count * static_cast<double>(1 + 0.2f * (p.x - 0.45f));
    }
    // Cells of the picture end between the points.
    const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
    EXPECT_NEAR(total, samples, 1e-2 * samples);
    for (double& count : expected) {
        count = count * samples / total + 0.01;
    }
    EXPECT_GE(chi_square_test(observed, expected).p_value, test::passing);
    EXPECT_LT(chi_square_test(observed, twin).p_value, test::failing);
}

TEST(Windowed, NothingIsDrawnWhereAllIsDarkOrEmpty) {
    const Windowed distribution = uneven();
    // Of the first two cells of the second row.
    EXPECT_FALSE(distribution.sample({0.5f, 0.5f}, {{0.01f, 0.26f}, {0.39f, 0.49f}}));
    EXPECT_FALSE(distribution.sample({0.5f, 0.5f}, {{0.5f, 0.2f}, {0.5f, 0.8f}}));
    EXPECT_EQ(distribution.density({0.1f, 0.5f}, window), 0);
    for (const float u : {0.0f, one_minus_epsilon}) {
        const auto s = distribution.sample({u, u}, window);
        ASSERT_TRUE(s);
        EXPECT_GT(s->density, 0);
    }
}

}  // namespace
}  // namespace wend
