#include <wend/numeric/fast_math.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wend {
namespace {

TEST(FastExp, StaysWithinItsStatedError) {
    double worst = 0;
    for (double x = fast_exp_smallest; x <= 88; x += 0.000317) {
        const float argument = static_cast<float>(x);
        const double exact = std::exp(static_cast<double>(argument));
        worst = std::max(worst, std::abs(fast_exp(argument) / exact - 1));
    }
    EXPECT_LT(worst, 5e-7);
    EXPECT_GT(worst, 1e-8);  // or nothing was measured
}

TEST(FastExpm1, KeepsTheDigitsOfSmallArguments) {
    double worst = 0;
    for (double size = 1e-8; size < 80; size *= 1.0037) {
        for (const auto x : {static_cast<float>(size), static_cast<float>(-size)}) {
            worst = std::max(worst, std::abs(fast_expm1(x) / std::expm1(static_cast<double>(x)) - 1));
        }
    }
    EXPECT_LT(worst, 1e-6);
    // The twin: subtracting 1 afterwards loses them.
    EXPECT_GT(std::abs((fast_exp(1e-6f) - 1) / std::expm1(1e-6) - 1), 1e-3);
}

TEST(FastExp, IsOneAtZeroAndNeverZeroOrInfinite) {
    EXPECT_EQ(fast_exp(0), 1);
    for (const float x :
         {-88.0f, -1e10f, -std::numeric_limits<float>::infinity(), std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_EQ(fast_exp(x), fast_exp(fast_exp_smallest));
    }
    EXPECT_GE(fast_exp(-1e30f), std::numeric_limits<float>::min());
}

}  // namespace
}  // namespace wend
