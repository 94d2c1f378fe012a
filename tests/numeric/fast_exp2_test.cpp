#include <wend/numeric/fast_math.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wend {
namespace {

TEST(FastExp2, StaysWithinItsStatedError) {
    double worst = 0;
    for (double x = fast_exp2_smallest; x <= 127; x += 0.000431) {
        const float argument = static_cast<float>(x);
        worst = std::max(worst, std::abs(fast_exp2(argument) / std::exp2(static_cast<double>(argument)) - 1));
    }
    EXPECT_LT(worst, 3e-7);
    EXPECT_GT(worst, 1e-8);  // or nothing was measured
}

TEST(FastExp2m1, KeepsTheDigitsOfSmallArguments) {
    double worst = 0;
    for (double size = 1e-8; size < 115; size *= 1.0037) {
        for (const auto x : {static_cast<float>(size), static_cast<float>(-size)}) {
            const double exact = std::expm1(static_cast<double>(x) * std::log(2.0));
            worst = std::max(worst, std::abs(fast_exp2m1(x) / exact - 1));
        }
    }
    EXPECT_LT(worst, 1e-6);
    EXPECT_GT(worst, 1e-8);
}

TEST(FastExp2, IsExactForIntegersAndNeverZeroOrInfinite) {
    for (int n = -115; n <= 127; ++n) {
        EXPECT_EQ(fast_exp2(static_cast<float>(n)), std::ldexp(1.0f, n));
    }
    for (const float x : {-1e10f, -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_EQ(fast_exp2(x), fast_exp2(fast_exp2_smallest));
    }
}

}  // namespace
}  // namespace wend
