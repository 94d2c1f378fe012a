#include <wend/core/random.h>
#include <wend/stats/figure_of_merit.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

Moments moments_of(std::initializer_list<double> values) {
    Moments moments;
    for (const double value : values) {
        moments.add(value);
    }
    return moments;
}

TEST(Moments, AreThoseOfASmallSample) {
    const Moments moments = moments_of({2, 4, 4, 4, 5, 5, 7, 9});
    EXPECT_EQ(moments.count(), 8u);
    EXPECT_DOUBLE_EQ(moments.mean(), 5);
    EXPECT_DOUBLE_EQ(moments.variance(), 32.0 / 7);
    EXPECT_DOUBLE_EQ(moments.standard_error(), std::sqrt(4.0 / 7));
    EXPECT_DOUBLE_EQ(moments.relative_error(), std::sqrt(4.0 / 7) / 5);
}

TEST(Moments, KeepTheVarianceOfValuesFarFromZero) {
    // The textbook formula, mean of squares less square of mean, has no digit left here.
    const Moments moments = moments_of({1e9 + 4, 1e9 + 7, 1e9 + 13, 1e9 + 16});
    EXPECT_DOUBLE_EQ(moments.variance(), 30);
}

TEST(Moments, MergeAsIfAddedInOneStream) {
    Moments whole, merged;
    Pcg32 random(7);
    for (int part = 0; part < 10; ++part) {
        Moments moments;
        for (int i = 0; i < 100 * part; ++i) {
            const double value = random.uniform() + part;
            moments.add(value);
            whole.add(value);
        }
        merged.merge(moments);
    }
    EXPECT_EQ(merged.count(), whole.count());
    EXPECT_NEAR(merged.mean(), whole.mean(), 1e-12 * whole.mean());
    EXPECT_NEAR(merged.variance(), whole.variance(), 1e-12 * whole.variance());
}

TEST(Moments, OfNothingAndOfOneValueHaveNoError) {
    Moments moments;
    moments.merge(Moments{});
    EXPECT_EQ(moments.mean(), 0);
    EXPECT_EQ(moments.standard_error(), 0);
    moments.add(3);
    EXPECT_EQ(moments.variance(), 0);
    EXPECT_EQ(moments.relative_error(), 0);
}

TEST(Moments, AroundZeroHaveAnInfiniteRelativeError) {
    EXPECT_TRUE(std::isinf(moments_of({-1, 1}).relative_error()));
}

TEST(FigureOfMerit, IsOneOverSquaredRelativeErrorTimesSeconds) {
    const Moments moments = moments_of({1, 3});  // mean 2, standard error 1
    EXPECT_DOUBLE_EQ(figure_of_merit(moments, 8).value(), 0.5);
}

TEST(FigureOfMerit, IsAbsentWithoutVariance) {
    EXPECT_FALSE(figure_of_merit(moments_of({2, 2, 2}), 1).has_value());
}

}  // namespace
}  // namespace wend
