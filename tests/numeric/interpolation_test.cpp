#include <wend/numeric/interpolation.h>

#include <gtest/gtest.h>

#include <vector>

namespace wend {
namespace {

TEST(Interpolate, IsLinearBetweenValuesAndConstantBeyondThem) {
    const std::vector<double> values = {1, 3, 2, 2.5};
    EXPECT_DOUBLE_EQ(interpolate(values, 0), 1);
    EXPECT_DOUBLE_EQ(interpolate(values, 1), 2.5);
    EXPECT_DOUBLE_EQ(interpolate(values, 1.0 / 6), 2);
    EXPECT_DOUBLE_EQ(interpolate(values, 0.5), 2.5);
    EXPECT_NEAR(interpolate(values, 2.0 / 3), 2, 1e-15);
    EXPECT_DOUBLE_EQ(interpolate(values, -7), 1);
    EXPECT_DOUBLE_EQ(interpolate(values, 1e300), 2.5);
}

TEST(Interpolate, NeedsTwoValuesOnly) {
    EXPECT_DOUBLE_EQ(interpolate({4, 8}, 0.25), 5);
    EXPECT_DOUBLE_EQ(interpolate({4, 8}, 1), 8);
}

}  // namespace
}  // namespace wend
