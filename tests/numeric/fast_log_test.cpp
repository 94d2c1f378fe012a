#include <wend/numeric/fast_math.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend {
namespace {

TEST(FastLog, StaysWithinItsStatedError) {
    double worst = 0;
    for (double exponent = -87; exponent < 88; exponent += 0.000917) {
        const auto x = static_cast<float>(std::exp(exponent));
        const double exact = std::log(static_cast<double>(x));
        worst = std::max(worst, std::abs(static_cast<double>(fast_log(x)) - exact) / std::max(std::abs(exact), 1e-30));
    }
    EXPECT_LT(worst, 2e-7);
    EXPECT_GT(worst, 1e-8);  // or nothing was measured
}

TEST(FastLog, IsExactAtOne) {
    EXPECT_EQ(fast_log(1), 0);
    EXPECT_EQ(fast_log1p(0), 0);
    EXPECT_NEAR(fast_log(std::numeric_limits<float>::min()), -87.3365448, 1e-5);
}

TEST(FastLog1p, KeepsTheDigitsOfSmallArguments) {
    double worst = 0;
    for (double x = 1e-12; x < 0.9; x *= 1.0037) {
        for (const auto argument : {static_cast<float>(x), static_cast<float>(-x)}) {
            const double exact = std::log1p(static_cast<double>(argument));
            worst = std::max(worst, std::abs(static_cast<double>(fast_log1p(argument)) / exact - 1));
        }
    }
    EXPECT_LT(worst, 5e-7);
    // The twin: adding 1 first loses them.
    EXPECT_GT(std::abs(static_cast<double>(fast_log(1 + 1e-6f)) / std::log1p(1e-6) - 1), 1e-3);
}

}  // namespace
}  // namespace wend
