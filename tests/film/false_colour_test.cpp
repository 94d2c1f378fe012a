#include <wend/core/error.h>
#include <wend/film/false_colour.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wend {
namespace {

TEST(FalseColour, IsDisplayableAndGetsLighterAllTheWay) {
    float previous = 0;
    for (int i = 0; i <= 1000; ++i) {
        const Rgb colour = false_colour(static_cast<float>(i) / 1000);
        EXPECT_GE(min_value(colour), 0) << i;
        EXPECT_LE(max_value(colour), 1) << i;
        EXPECT_GT(luminance(colour), previous) << i;
        previous = luminance(colour);
    }
    EXPECT_LT(luminance(false_colour(0.0f)), 0.01f);
    EXPECT_GT(luminance(false_colour(1.0f)), 0.7f);
}

TEST(FalseColour, LinearScaleReachesBothEndsAndStaysThere) {
    const ColourScale scale{ColourScale::Kind::linear, 2, 6};
    EXPECT_EQ(scale.position(1), 0);
    EXPECT_EQ(scale.position(2), 0);
    EXPECT_FLOAT_EQ(scale.position(3), 0.25f);
    EXPECT_EQ(scale.position(6), 1);
    EXPECT_EQ(scale.position(std::numeric_limits<float>::infinity()), 1);
    EXPECT_EQ(scale.position(std::numeric_limits<float>::quiet_NaN()), 1);
}

TEST(FalseColour, LogarithmicScaleGivesDecadesEqualShares) {
    const ColourScale scale{ColourScale::Kind::logarithmic, 1e-2f, 1e2f};
    EXPECT_NEAR(scale.position(0.1f), 0.25f, 1e-6);
    EXPECT_NEAR(scale.position(1), 0.5f, 1e-6);
    EXPECT_EQ(scale.position(-3), 0);
}

TEST(FalseColour, PictureHasTheColoursOfItsValues) {
    const Image picture = false_colour({0, 1, 0.5f, 2}, 2, 2, {});
    EXPECT_EQ(picture.at(0, 0), false_colour(0.0f));
    EXPECT_EQ(picture.at(1, 0), false_colour(1.0f));
    EXPECT_EQ(picture.at(0, 1), false_colour(0.5f));
    EXPECT_EQ(picture.at(1, 1), false_colour(1.0f));
}

TEST(FalseColour, RefusesWrongCountsAndEmptyScales) {
    EXPECT_THROW(false_colour({1, 2, 3}, 2, 2, {}), InputError);
    EXPECT_THROW(false_colour({1}, -1, -1, {}), InputError);
    EXPECT_THROW(false_colour({1}, 1, 1, {ColourScale::Kind::linear, 1, 1}), InputError);
    EXPECT_THROW(false_colour({1}, 1, 1, {ColourScale::Kind::logarithmic, 0, 1}), InputError);
}

}  // namespace
}  // namespace wend
