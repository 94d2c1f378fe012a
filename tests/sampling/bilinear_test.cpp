#include <wend/core/random.h>
#include <wend/sampling/bilinear.h>
#include <wend/stats/chi_square.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <numeric>
#include <vector>

namespace wend {
namespace {

/// Slices of 5 x 4: uneven, with an edge of zeros, of one entry alone, and of zeros.
BilinearTable<float> uneven_table() {
    BilinearTable<float> table{5, 4, {}};
    Pcg32 random(7);
    for (int i = 0; i < 20; ++i) {
        table.values.push_back(random.uniform());
    }
    for (int i = 0; i < 20; ++i) {
        table.values.push_back(i % 5 == 0 || i < 5 ? 0 : 3 + random.uniform());
    }
    table.values.resize(60, 0.0f);
    table.values[47] = 2;
    table.values.resize(80, 0.0f);
    return table;
}

std::vector<SliceBlend> blends() {
    return {{{0}, {1}, 1},
            {{1}, {1}, 1},
            {{2}, {1}, 1},
            {{3}, {1}, 1},
            {{0, 1}, {0.3f, 0.7f}, 2},
            {{0, 1, 2, 3}, {0.1f, 0.2f, 0.3f, 0.4f}, 4}};
}

TEST(BilinearDensity, SamplesFollowTheDensity) {
    const BilinearDensity density(uneven_table());
    constexpr std::size_t side = 12;
    constexpr int samples = 40000, steps = 32;
    for (const SliceBlend& blend : blends()) {
        std::vector<std::uint64_t> observed(side * side);
        std::vector<double> expected(side * side);
        for (std::size_t cell = 0; cell < expected.size(); ++cell) {
            for (int i = 0; i < steps * steps; ++i) {
                const Vec2 within((static_cast<float>(i % steps) + 0.5f) / steps,
                                  (static_cast<float>(i / steps) + 0.5f) / steps);
                const Vec2 p((static_cast<float>(cell % side) + within.x) / side,
                             (static_cast<float>(cell / side) + within.y) / side);
                expected[cell] += double{density.density(blend, p)} * samples / (steps * steps * side * side);
            }
        }
        const double total = std::accumulate(expected.begin(), expected.end(), 0.0);
        EXPECT_NEAR(total, samples, 0.005 * samples);
        for (double& count : expected) {
            count *= samples / total;
        }
        Pcg32 random(1);
        for (int i = 0; i < samples; ++i) {
            const Vec2 p = density.sample(blend, random.uniform2()).position;
            const auto cell = [](float x) { return std::min(static_cast<std::size_t>(x * side), side - 1); };
            ++observed[cell(p.y) * side + cell(p.x)];
        }
        EXPECT_GT(chi_square_test(observed, expected).p_value, 1e-4);
    }
}

TEST(BilinearDensity, InvertUndoesSample) {
    const BilinearDensity density(uneven_table());
    Pcg32 random(2);
    for (const SliceBlend& blend : blends()) {
        for (int i = 0; i < 2000; ++i) {
            const Vec2 u = random.uniform2();
            const auto p = density.sample(blend, u);
            ASSERT_GT(p.density, 0);
            EXPECT_NEAR(p.density, density.density(blend, p.position), 1e-3f * p.density + 1e-4f);
            const auto back = density.invert(blend, p.position);
            EXPECT_NEAR(back.position.x, u.x, 1e-3f) << p.position;
            EXPECT_NEAR(back.position.y, u.y, 1e-3f) << p.position;
            EXPECT_NEAR(back.density, p.density, 1e-3f * p.density + 1e-4f);
        }
    }
}

TEST(BilinearDensity, ASliceOfZerosIsEven) {
    const BilinearDensity density(uneven_table());
    const SliceBlend zeros{{3}, {1}, 1};
    for (const Vec2& u : {Vec2(0, 0), Vec2(0.25f, 0.7f), Vec2(1, 1)}) {
        EXPECT_NEAR((density.sample(zeros, u).position - u).length(), 0, 1e-6f);
        EXPECT_FLOAT_EQ(density.density(zeros, u), 1);
    }
}

}  // namespace
}  // namespace wend
