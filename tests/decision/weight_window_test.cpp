#include <wend/core/random.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wend {
namespace {

const std::vector<double> ratios = {0.0, 1e-9, 0.01, 0.3, 0.34, 1.0, 1.6, 1.7, 2.0, 3.25, 40.9, 1e12};

/// The weight that goes on, in the mean, of a walk of weight 1.
Moments weight_after(const WeightWindow& window, double ratio) {
    Pcg32 random(7);
    Moments moments;
    for (int i = 0; i < 100000; ++i) {
        const WeightWindow::Outcome outcome = window.sample(ratio, random);
        moments.add(outcome.copies / outcome.expected);
    }
    return moments;
}

TEST(WeightWindow, KeepsTheWeightInTheMean) {
    for (const double ratio : ratios) {
        const Moments after = weight_after({}, ratio);
        EXPECT_NEAR(after.mean(), 1, 4 * after.standard_error() + 1e-12) << "ratio " << ratio;
    }
}

TEST(WeightWindow, CutsAndSplitsByTheRatio) {
    Pcg32 random(1);
    const WeightWindow window;
    for (const double ratio : {window.low, 1.0, window.high}) {
        const WeightWindow::Outcome inside = window.sample(ratio, random);
        EXPECT_EQ(inside.copies, 1);
        EXPECT_EQ(inside.expected, 1);
    }
    Moments cut, split;
    for (int i = 0; i < 100000; ++i) {
        cut.add(window.sample(0.25, random).copies);
        split.add(window.sample(2.25, random).copies);
    }
    EXPECT_NEAR(cut.mean(), 0.25, 4 * cut.standard_error());
    EXPECT_NEAR(split.mean(), 2.25, 4 * split.standard_error());
    EXPECT_GT(std::abs(split.mean() - 2), 40 * split.standard_error());
}

TEST(WeightWindow, TakesNumbersFromAnywhere) {
    const WeightWindow window;
    for (const double ratio : {0.01, 0.2, 1.0, 1.7, 2.0, 30.5, 1000.0}) {
        for (std::uint64_t key = 0; key < 100; ++key) {
            Pcg32 random(key), same(key);
            int asked = 0;
            const WeightWindow::Outcome outcome = window.sample(ratio, [&] {
                ++asked;
                return same.uniform_double();
            });
            const WeightWindow::Outcome expected = window.sample(ratio, random);
            EXPECT_EQ(outcome.copies, expected.copies);
            EXPECT_EQ(outcome.expected, expected.expected);
            EXPECT_EQ(asked, ratio == 1 ? 0 : 1);
            EXPECT_EQ(random.next(), same.next());
        }
    }
}

TEST(WeightWindow, LimitsBothWays) {
    Pcg32 random(1);
    const WeightWindow window;
    EXPECT_EQ(window.sample(0, random).expected, window.least);
    EXPECT_EQ(window.sample(std::numeric_limits<double>::infinity(), random).copies, window.most);
    EXPECT_EQ(window.sample(1e300, random).copies, window.most);
    EXPECT_EQ(window.sample(std::numeric_limits<double>::quiet_NaN(), random).copies, 1);
    EXPECT_EQ(window.sample(-1, random).copies, 1);
}

}  // namespace
}  // namespace wend
