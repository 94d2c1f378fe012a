#include <wend/decision/survival.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

TEST(ClassicalSurvival, FollowsTheBrightestChannelAfterAStart) {
    const ClassicalSurvival survival;
    EXPECT_EQ(survival.expected_continuations({Rgb(0.01f), 1, 1, 0}), 1);
    EXPECT_EQ(survival.expected_continuations({Rgb(0.01f), 1, 1, 1}), 1);
    EXPECT_FLOAT_EQ(survival.expected_continuations({Rgb(0.1f, 0.3f, 0.2f), 1, 1, 2}), 0.3f);
    EXPECT_EQ(survival.expected_continuations({Rgb(5), 1, 1, 2}), 1);
}

TEST(ClassicalSurvival, EnteringADenserMediumDoesNotEndWalks) {
    // Radiance is 1/n² there; undone by the index scale.
    EXPECT_FLOAT_EQ(ClassicalSurvival().expected_continuations({Rgb(1 / 2.25f), 1, 2.25f, 2}), 1);
}

}  // namespace
}  // namespace wend
