#include <wend/core/colour.h>

#include <gtest/gtest.h>

#include <limits>

namespace wend {
namespace {

TEST(Rgb, ArithmeticIsPerChannel) {
    const Rgb a(1, 2, 4), b(0.5f, 4, 2);
    EXPECT_EQ(a + b, Rgb(1.5f, 6, 6));
    EXPECT_EQ(a - b, Rgb(0.5f, -2, 2));
    EXPECT_EQ(a * b, Rgb(0.5f, 8, 8));
    EXPECT_EQ(a / b, Rgb(2, 0.5f, 2));
    EXPECT_EQ(2 * a, a + a);
    EXPECT_EQ(a / 2, Rgb(0.5f, 1, 2));
}

TEST(Rgb, IndexNamesTheChannels) {
    Rgb c(1, 2, 3);
    EXPECT_EQ(c[0], c.r);
    EXPECT_EQ(c[1], c.g);
    EXPECT_EQ(c[2], c.b);
    c[1] = 7;
    EXPECT_EQ(c, Rgb(1, 7, 3));
}

TEST(Rgb, Summaries) {
    const Rgb c(0.25f, 1, 0.5f);
    EXPECT_EQ(max_value(c), 1);
    EXPECT_EQ(min_value(c), 0.25f);
    EXPECT_FLOAT_EQ(mean(c), 1.75f / 3);
    EXPECT_FLOAT_EQ(luminance(Rgb(1)), 1);
    EXPECT_GT(luminance(Rgb(0, 1, 0)), luminance(Rgb(1, 0, 0)));
    EXPECT_TRUE(is_black(Rgb()));
    EXPECT_FALSE(is_black(Rgb(0, 0, 1e-30f)));
    EXPECT_FLOAT_EQ(exp(Rgb(1, 0, -1)).b, std::exp(-1.0f));
}

TEST(Rgb, OneBadChannelMakesAColourNotFinite) {
    EXPECT_TRUE(is_finite(Rgb(1, 2, 3)));
    EXPECT_FALSE(is_finite(Rgb(1, std::numeric_limits<float>::quiet_NaN(), 3)));
    EXPECT_FALSE(is_finite(Rgb(1, 2, std::numeric_limits<float>::infinity())));
}

}  // namespace
}  // namespace wend
