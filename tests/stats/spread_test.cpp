#include <wend/stats/spread.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace wend {
namespace {

TEST(Spread, QuantilesAreLinearBetweenValues) {
    const std::vector<double> values = {1, 2, 4, 8};
    EXPECT_DOUBLE_EQ(quantile(values, 0), 1);
    EXPECT_DOUBLE_EQ(quantile(values, 1), 8);
    EXPECT_DOUBLE_EQ(quantile(values, 0.5), 3);
    EXPECT_DOUBLE_EQ(quantile(values, 0.25), 1.75);
    EXPECT_DOUBLE_EQ(quantile({5}, 0.9), 5);
    EXPECT_TRUE(std::isnan(quantile({}, 0.5)));
}

TEST(Spread, IsThatOfASmallSample) {
    const Spread spread = spread_of({9, 2, 4, 4, 5, 4, 7, 5});
    EXPECT_EQ(spread.count, 8u);
    EXPECT_DOUBLE_EQ(spread.median, 4.5);
    EXPECT_DOUBLE_EQ(spread.min, 2);
    EXPECT_DOUBLE_EQ(spread.max, 9);
    EXPECT_DOUBLE_EQ(spread.mean, 5);
    EXPECT_DOUBLE_EQ(spread.std_error, std::sqrt(4.0 / 7));
}

TEST(Spread, LeavesOutWhatIsNoNumberAndSaysSo) {
    constexpr double infinity = std::numeric_limits<double>::infinity();
    const Spread spread = spread_of({3, infinity, std::nan(""), 1});
    EXPECT_EQ(spread.count, 2u);
    EXPECT_DOUBLE_EQ(spread.median, 2);
    EXPECT_DOUBLE_EQ(spread.max, 3);
    EXPECT_TRUE(std::isnan(spread_of({7}).std_error)) << "one value tells nothing of its error";
    EXPECT_EQ(spread_of({infinity}).count, 0u);
    EXPECT_TRUE(std::isnan(spread_of({}).median));
}

}  // namespace
}  // namespace wend
