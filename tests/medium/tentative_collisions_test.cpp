// The Poisson process of tracking: as many collisions in each cell as its rate says, evenly spread, whatever is before.
#include <wend/medium/tentative_collisions.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace wend {
namespace {

struct Cell {
    double begin, end, rate;
};
// With an empty one, one of no length and a very dense one.
constexpr std::array cells{Cell{0, 1, 0.5}, Cell{1, 1.5, 0}, Cell{1.5, 1.5, 3}, Cell{1.5, 1.6, 400}, Cell{1.6, 3, 2}};

TEST(TentativeCollisions, EachCellHasAsManyAsItsRateSaysEvenlySpread) {
    Pcg32 random(1);
    constexpr int rays = 200000;
    std::array<Moments, cells.size()> counts, places;
    Moments first_and_last;  // product of deviations: cells are independent
    for (int i = 0; i < rays; ++i) {
        TentativeCollisions collisions(random);
        std::array<int, cells.size()> here{};
        for (std::size_t c = 0; c < cells.size(); ++c) {
            for (double t = cells[c].begin; collisions.next(t, cells[c].end, cells[c].rate);) {
                ASSERT_GE(t, cells[c].begin);
                ASSERT_LE(t, cells[c].end);
                ++here[c];
                places[c].add((t - cells[c].begin) / (cells[c].end - cells[c].begin));
            }
            counts[c].add(here[c]);
        }
        first_and_last.add((here.front() - 0.5) * (here.back() - 2.8));
    }
    for (std::size_t c = 0; c < cells.size(); ++c) {
        const double expected = cells[c].rate * (cells[c].end - cells[c].begin);
        EXPECT_NEAR(counts[c].mean(), expected, 4 * counts[c].standard_error()) << c;
        EXPECT_NEAR(counts[c].variance(), expected, 0.02 * expected) << c;
        if (expected > 0) {
            EXPECT_NEAR(places[c].mean(), 0.5, 4 * places[c].standard_error()) << c;
            EXPECT_NEAR(places[c].variance(), 1.0 / 12, 0.001) << c;
        } else {
            EXPECT_EQ(counts[c].mean(), 0) << c;
        }
    }
    EXPECT_NEAR(first_and_last.mean(), 0, 4 * first_and_last.standard_error());
}

TEST(TentativeCollisions, StaysWhereNoneIsLeft) {
    Pcg32 random(2);
    TentativeCollisions collisions(random);
    double t = 0.25;
    EXPECT_FALSE(collisions.next(t, 10, 0));
    EXPECT_EQ(t, 0.25);
    EXPECT_FALSE(collisions.next(t, 0.25, 1e30));
    EXPECT_TRUE(collisions.next(t, 10, 1e30));
    EXPECT_GE(t, 0.25);
    EXPECT_LT(t, 0.2500001);
}

}  // namespace
}  // namespace wend
