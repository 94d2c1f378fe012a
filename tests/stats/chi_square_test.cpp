#include <wend/core/random.h>
#include <wend/stats/chi_square.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace wend {
namespace {

using Counts = std::vector<std::uint64_t>;

TEST(ChiSquare, MatchesMendelsPeas) {
    // Round/wrinkled by yellow/green, 9:3:3:1 expected of 556: the statistic is 0.470.
    const ChiSquare result =
        chi_square_test(Counts{315, 108, 101, 32}, std::vector<double>{312.75, 104.25, 104.25, 34.75});
    EXPECT_EQ(result.degrees_of_freedom, 3);
    EXPECT_NEAR(result.statistic, 0.470024, 1e-6);
    EXPECT_NEAR(result.p_value, 0.925426, 1e-6);
}

TEST(ChiSquare, PoolsThinCellsUntilThePoolIsFilled) {
    // 1 + 2 stay below 5, so the next larger cell joins them: {13 of 13, 20 of 20, 30 of 30}.
    const ChiSquare result = chi_square_test(Counts{20, 2, 10, 1, 30}, std::vector<double>{20, 2, 10, 1, 30});
    EXPECT_EQ(result.degrees_of_freedom, 2);
    EXPECT_EQ(result.statistic, 0);
    EXPECT_EQ(result.p_value, 1);
}

TEST(ChiSquare, GivesNoChanceToTheImpossible) {
    const ChiSquare result = chi_square_test(Counts{1, 50, 49}, std::vector<double>{0, 50, 50});
    EXPECT_EQ(result.p_value, 0);
    EXPECT_TRUE(std::isinf(result.statistic));
}

TEST(ChiSquare, RefusesATestThatCannotFail) {
    EXPECT_THROW(chi_square_test(Counts{3, 1}, std::vector<double>{2, 2}), std::invalid_argument);
    EXPECT_THROW(chi_square_test(Counts{}, std::vector<double>{}), std::invalid_argument);
}

TEST(ChiSquare, RefusesMalformedExpectations) {
    const double nan = std::numeric_limits<double>::quiet_NaN();
    EXPECT_THROW(chi_square_test(Counts{9}, std::vector<double>{9, 9}), std::invalid_argument);
    EXPECT_THROW(chi_square_test(Counts{9, 9}, std::vector<double>{-9, 9}), std::invalid_argument);
    EXPECT_THROW(chi_square_test(Counts{9, 9}, std::vector<double>{nan, 9}), std::invalid_argument);
}

/// Share of 1000 repetitions with p below 0.05, counting uniform numbers in ten cells whose first one is wider by
/// `bias`.
double rejected_share(double bias) {
    const std::vector<double> expected(10, 100.0);
    int rejected = 0;
    for (int repetition = 0; repetition < 1000; ++repetition) {
        Pcg32 random(hash_of(5, repetition));
        Counts observed(10);
        for (int i = 0; i < 1000; ++i) {
            const double u = random.uniform();
            ++observed[u < bias ? 0 : static_cast<int>(10 * u)];
        }
        rejected += chi_square_test(observed, expected).p_value < 0.05;
    }
    return rejected / 1000.0;
}

TEST(ChiSquare, RejectsTheTrueHypothesisAtItsSignificance) {
    EXPECT_NEAR(rejected_share(0), 0.05, 4 * std::sqrt(0.05 * 0.95 / 1000));
}

TEST(ChiSquare, RejectsAWrongHypothesis) {
    EXPECT_GT(rejected_share(0.15), 0.95);
}

}  // namespace
}  // namespace wend
