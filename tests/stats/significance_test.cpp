#include <wend/core/random.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

Moments uniform_mean(double offset) {
    Moments moments;
    Pcg32 random(11);
    for (int i = 0; i < 100000; ++i) {
        moments.add(random.uniform() + offset);
    }
    return moments;
}

TEST(Agrees, AcceptsTheMeanOfUniformNumbers) {
    EXPECT_TRUE(agrees(uniform_mean(0), 0.5, 4));
}

TEST(Agrees, RejectsAOnePercentBias) {
    EXPECT_FALSE(agrees(uniform_mean(0.005), 0.5, 4));
}

TEST(Agrees, HasNoVarianceFloor) {
    EXPECT_TRUE(agrees(1e-6 * (1 + 1e-13), 0, 1e-6, 4));
    EXPECT_FALSE(agrees(1.01e-6, 0, 1e-6, 4)) << "a dark estimate that is 1 % wrong without noise must be seen";
}

TEST(Agrees, RejectsWhatIsNotANumber) {
    EXPECT_FALSE(agrees(std::nan(""), 1, 0, 4));
    EXPECT_FALSE(agrees(0, std::nan(""), 0, 4));
}

TEST(TwoSidedPValue, HasTheWellKnownQuantiles) {
    EXPECT_NEAR(two_sided_p_value(1.959963984540054), 0.05, 1e-12);
    EXPECT_NEAR(two_sided_p_value(-3), 0.0026997960632602, 1e-14);
    EXPECT_EQ(two_sided_p_value(0), 1);
}

TEST(Sidak, KeepsTheJointSignificance) {
    EXPECT_DOUBLE_EQ(sidak(0.01, 1), 0.01);
    EXPECT_NEAR(1 - std::pow(1 - sidak(0.01, 50), 50), 0.01, 1e-14);
}

}  // namespace
}  // namespace wend
