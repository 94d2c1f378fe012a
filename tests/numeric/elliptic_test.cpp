#include <wend/numeric/elliptic.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace wend {
namespace {

TEST(EllipticE, HasItsEndsInClosedForm) {
    EXPECT_DOUBLE_EQ(elliptic_e(0), std::numbers::pi / 2);
    EXPECT_EQ(elliptic_e(1), 1);
}

TEST(EllipticE, AgreesWithThirtyDigits) {
    struct Row {
        double m, expected;
    };
    for (const auto& [m, expected] :
         {Row{1e-09, 1.57079632640219754}, Row{0.01, 1.56686194202166829}, Row{0.1, 1.5307576368977632},
          Row{0.25, 1.46746220933942716}, Row{0.5, 1.3506438810476755}, Row{0.831, 1.15707937712767528},
          Row{0.9, 1.10477473270407331}, Row{0.99, 1.01599354502522395}, Row{0.999, 1.00217079083444517},
          Row{0.999999, 1.00000389702617217}}) {
        EXPECT_NEAR(elliptic_e(m), expected, 1e-15 * expected) << "m = " << m;
    }
}

TEST(EllipticE, FollowsItsExpansionNearOne) {
    for (double complement = 1e-5; complement > 1e-16; complement /= 7) {
        // abramowitz1964, 17.3.36 gives E for 1 - m << 1: 1 + (1 - m) (ln(4 / sqrt(1 - m)) - 1/2) / 2.
        const double m = 1 - complement;
        const double expected = 1 + (1 - m) * (std::log(16 / (1 - m)) - 1) / 4;
        EXPECT_NEAR(elliptic_e(m), expected, 1e-14 + 2 * complement * complement * -std::log(complement));
    }
}

}  // namespace
}  // namespace wend
