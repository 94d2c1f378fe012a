#include <wend/numeric/fast_math.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

TEST(FastTurn, StaysWithinItsStatedError) {
    constexpr double two_pi = 6.283185307179586;
    double worst = 0;
    constexpr int steps = 1 << 16;
    for (int i = 0; i <= steps; ++i) {
        const float u = static_cast<float>(i) / steps;
        const Turn turn = fast_turn(u);
        worst = std::max({worst, std::abs(turn.cosine - std::cos(two_pi * static_cast<double>(u))),
                          std::abs(turn.sine - std::sin(two_pi * static_cast<double>(u)))});
    }
    EXPECT_LT(worst, 1e-7);
    EXPECT_GT(worst, 1e-9);  // or nothing was measured
}

TEST(FastTurn, IsExactAtQuarters) {
    EXPECT_EQ(fast_turn(0).cosine, 1);
    EXPECT_EQ(fast_turn(0.25f).sine, 1);
    EXPECT_EQ(fast_turn(0.5f).cosine, -1);
    EXPECT_EQ(fast_turn(0.75f).sine, -1);
    EXPECT_EQ(fast_turn(1).cosine, 1);
    EXPECT_EQ(fast_turn(0).sine, 0);
}

}  // namespace
}  // namespace wend
