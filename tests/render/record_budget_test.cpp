#include <wend/render/record_budget.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

TEST(RecordBudget, RecordsAllWalksOfASmallPicture) {
    const RecordBudget budget(1e6);
    EXPECT_EQ(budget.share(1), 1);
    EXPECT_EQ(budget.share(1e4), 1);
}

TEST(RecordBudget, HoldsFromTheFirstPassOn) {
    // As many as a 4K picture has, whose walks tell ten records each.
    constexpr double walks = 8e6, per_walk = 10, most = 2e6;
    RecordBudget budget(most);
    for (int pass = 0; pass < 4; ++pass) {
        const double recorded = budget.share(walks) * walks;
        EXPECT_GT(recorded, 0);
        EXPECT_LE(recorded * per_walk, most * 1.0001);
        if (pass > 0) {
            EXPECT_GE(recorded * per_walk, most * 0.9999);
        }
        budget.learn(recorded, recorded * per_walk);
    }
}

TEST(RecordBudget, KeepsItsGuessWhereNothingWasTold) {
    RecordBudget budget(100);
    const double before = budget.share(1e6);
    budget.learn(0, 0);
    budget.learn(100, 0);
    EXPECT_EQ(budget.share(1e6), before);
}

}  // namespace
}  // namespace wend
