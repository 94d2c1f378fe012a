// Which walks are guided: by what walks of each kind have shown.
#include <wend/render/guiding_choice.h>
#include <wend/render/learner.h>

#include <gtest/gtest.h>

#include <array>
#include <numeric>
#include <utility>
#include <vector>

namespace wend {
namespace {

constexpr std::size_t classical_kind = 0, survival = 1, directions = 2;
constexpr double many_pixels = GuidingChoice::fewest_pixels;

/// Walks that each brought the pixel's value but for an error of this variance; and, gone the same ways unguided, of
/// another, where that is known.
WalkTally walks(double count, double variance, double work, double unguided = 0) {
    return {count, count, count * variance, count * variance, count * work, count * unguided};
}

/// Tallies of tiles where all kinds see classical walks as those see themselves.
std::vector<WalkTallies> agreeing(std::vector<WalkTallies> tiles) {
    for (WalkTallies& tile : tiles) {
        for (WalkTally& kind : tile) {
            kind.unguided = tile[classical_kind].walks > 0
                                ? kind.walks * tile[classical_kind].square / tile[classical_kind].walks
                                : 0;
        }
    }
    return tiles;
}

/// Of a scene without fog, taught by classical walks, with every kind about to be tried.
GuidingChoice untried(std::size_t tiles) {
    GuidingChoice choice(parse_preset("full"), {}, false, tiles, many_pixels);
    const std::vector<WalkTallies> nothing(tiles);
    choice.learn(nothing, 1, true);
    choice.learn(nothing, warm_up_samples, true);
    return choice;
}

/// The same, with every kind tried.
GuidingChoice tried(std::size_t tiles, const std::vector<WalkTallies>& shown) {
    GuidingChoice choice = untried(tiles);
    choice.learn(agreeing(shown), 15, false);
    return choice;
}

TEST(GuidingChoice, APresetThatIsNamedInFullIsNotChosenFrom) {
    for (const char* name : {"classical", "direction", "distance+direction+roulette+splitting"}) {
        GuidingChoice choice(parse_preset(name), {.flights = true, .dense_media = true}, false, 3, many_pixels);
        ASSERT_EQ(choice.kinds().size(), 1u) << name;
        EXPECT_EQ(choice.kinds()[0], (WalkKind{parse_preset(name), true}));
        const std::vector<WalkTallies> shown(3, {walks(1000, 1, 1)});
        EXPECT_FALSE(choice.learn(shown, 15, true)) << name;
        EXPECT_EQ(choice.shares(2, 1), WalkShares{1});
        EXPECT_EQ(choice.recorded_share(1), 1);
        EXPECT_EQ(choice.directed_share(1), choice.kinds()[0].preset.direction ? 1 : 0) << name;
    }
}

TEST(GuidingChoice, FewPixelsAreGuidedInAllWays) {
    const GuidingChoice choice(parse_preset("full"), {.dense_media = true}, false, 1, many_pixels - 1);
    ASSERT_EQ(choice.kinds().size(), 1u);
    EXPECT_EQ(choice.kinds()[0], (WalkKind{parse_preset("distance+direction+roulette+splitting"), true}));
}

TEST(GuidingChoice, FlightsAreGuidedInFogAlone) {
    EXPECT_EQ(GuidingChoice(parse_preset("full"), {}, false, 1, many_pixels).kinds().size(), 3u);
    const GuidingChoice in_fog(parse_preset("full"), {.flights = true}, false, 1, many_pixels);
    ASSERT_EQ(in_fog.kinds().size(), 4u);
    EXPECT_TRUE(in_fog.kinds()[classical_kind].is_classical());
    EXPECT_EQ(in_fog.kinds()[3], (WalkKind{parse_preset("distance+direction+roulette+splitting"), false}));
}

TEST(GuidingChoice, GuidesOfDenseMediaAreAskedFromTheStart) {
    const GuidingChoice choice(parse_preset("full"), {.dense_media = true}, false, 1, many_pixels);
    ASSERT_EQ(choice.kinds().size(), 3u);
    EXPECT_EQ(choice.kinds()[0], (WalkKind{Preset(), true}));
    EXPECT_EQ(choice.kinds()[2], (WalkKind{parse_preset("direction+roulette+splitting"), true}));
    EXPECT_EQ(choice.shares(0, 1), WalkShares{1});
    EXPECT_TRUE(choice.guides(1)) << "they are to be explored before the first walk";
}

TEST(GuidingChoice, BeginsWithClassicalWalksAndThenTriesAll) {
    GuidingChoice choice(parse_preset("full"), {}, false, 2, many_pixels);
    const std::vector<WalkTallies> nothing(2);
    EXPECT_FALSE(choice.guides(8));
    EXPECT_EQ(choice.shares(1, 8), WalkShares{1});
    choice.learn(nothing, 1, true);
    EXPECT_FALSE(choice.learn(nothing, warm_up_samples - 1, true));
    EXPECT_TRUE(choice.learn(nothing, warm_up_samples, true));
    EXPECT_TRUE(choice.is_trial());
    for (const std::size_t kind : {classical_kind, survival, directions}) {
        EXPECT_FLOAT_EQ(choice.shares(1, 8)[kind], 1.0f / 3);
    }
    // Too short to try all: that pass shows nothing of the others, and the trial is still to come.
    EXPECT_EQ(choice.shares(1, 2), WalkShares{1});
    EXPECT_FALSE(choice.guides(2));
    EXPECT_TRUE(choice.guides(3));
    const std::vector<WalkTallies> short_pass(2, {walks(100, 1, 1)});
    EXPECT_FALSE(choice.learn(short_pass, 9, true));
    EXPECT_TRUE(choice.is_trial());
}

TEST(GuidingChoice, AFewWalksOfOtherKindsComeBeforeTheTrial) {
    const auto probed = [](double pixels, int samples) {
        GuidingChoice choice(parse_preset("full"), {}, false, 1, pixels);
        choice.learn(std::vector<WalkTallies>(1), 1, true);
        const WalkShares shares = choice.shares(0, samples);
        EXPECT_FLOAT_EQ(std::accumulate(shares.begin(), shares.end(), 0.0f), 1);
        EXPECT_EQ(shares[directions], shares[survival]);
        EXPECT_EQ(choice.guides(samples), shares[directions] > 0);
        EXPECT_NEAR(choice.directed_share(samples), static_cast<double>(shares[directions]), 1e-6);
        return shares[directions];
    };
    constexpr double small = 160 * 90, large = 1920 * 1080;
    EXPECT_EQ(probed(many_pixels, 4), 0) << "too few to show anything";
    EXPECT_EQ(probed(small, 2), 0) << "or too dear";
    EXPECT_NEAR(probed(small, 4), 1.0 / 12, 1e-6);
    // While all of the render may be a few samples, fewer.
    EXPECT_NEAR(probed(large, 2), 1.0 / 48, 1e-6);
    EXPECT_NEAR(probed(large, 4), 1.0 / 12, 1e-6);
}

TEST(GuidingChoice, WhereClassicalWalksAreFarBehindAtFirstDirectionsAreTriedAlone) {
    const auto trial_after = [](double classical_variance) {
        GuidingChoice choice(parse_preset("full"), {}, false, 1, many_pixels);
        choice.learn(std::vector<WalkTallies>(1), 1, true);
        choice.learn(agreeing({{walks(1000, classical_variance, 1), walks(100, 1, 1), walks(100, 2, 1)}}),
                     warm_up_samples, true);
        EXPECT_TRUE(choice.is_trial());
        return choice.shares(0, 8);
    };
    EXPECT_EQ(trial_after(10), (WalkShares{0, 0, 1}));
    EXPECT_FLOAT_EQ(trial_after(2)[classical_kind], 1.0f / 3);
}

TEST(GuidingChoice, StartsGuidedWhereThereIsAFieldFromTheStart) {
    const GuidingChoice choice(parse_preset("full"), {}, true, 1, many_pixels);
    EXPECT_TRUE(choice.guides(1));
    EXPECT_EQ(choice.shares(0, 1)[directions], 1);
}

TEST(GuidingChoice, TakesTheLeastSquaredErrorTimesWork) {
    // Errors ten times lower at twice the work.
    GuidingChoice guided = tried(1, {{walks(1000, 10, 3), walks(1000, 8, 4), walks(1000, 1, 6)}});
    EXPECT_EQ(guided.shares(0, 8), (WalkShares{0, 0, 1}));
    // A little lower at twice the work.
    GuidingChoice unguided = tried(1, {{walks(1000, 1, 3), walks(1000, 0.99, 8), walks(1000, 0.9, 9)}});
    EXPECT_GT(unguided.shares(0, 8)[classical_kind], 0.98f);
    EXPECT_EQ(unguided.shares(0, 8)[directions], 0);
}

TEST(GuidingChoice, ClassicalWalksThatHaveMissedWhatGuidedOnesMeetAreNotTakenToBeGood) {
    // Bright walks are so rare without guiding that none was there. Guided ones know how rare.
    const std::vector<WalkTallies> shown = {{walks(1000, 1, 1), walks(1000, 2, 1, 30), walks(1000, 3, 5, 50)}};
    GuidingChoice choice = untried(1);
    choice.learn(shown, 15, false);
    EXPECT_EQ(choice.shares(0, 8)[classical_kind], 0);
    EXPECT_GT(choice.shares(0, 8)[survival], 0.9f) << "each kind is judged by its own walks";
    // What guided walks show of a tile counts there more than what they show elsewhere.
    const WalkTallies easy = {walks(1e5, 1, 1), walks(1e5, 1, 1, 1), walks(1e5, 2, 5, 1)};
    const WalkTallies hard = {walks(1e5, 1, 1), walks(1e5, 1, 1, 1), walks(1e5, 2, 5, 100)};
    GuidingChoice two = untried(2);
    two.learn(std::vector<WalkTallies>{easy, hard}, 15, false);
    EXPECT_LT(two.shares(0, 8)[directions], 0.1f);
    EXPECT_GT(two.shares(1, 8)[directions], 0.9f);
}

TEST(GuidingChoice, TriesOnWhatIsCloseWhereItsNoiseIsNotSeen) {
    const GuidingChoice choice = tried(1, {{walks(1000, 3, 2), walks(1000, 1, 5), walks(1000, 1, 6)}});
    const WalkShares shares = choice.shares(0, 32);
    EXPECT_FLOAT_EQ(shares[directions], 1.0f / 16);
    // 3 times the squared error: a share s adds 2 s to that of the pixel.
    EXPECT_NEAR(shares[classical_kind], 0.02 / 2, 1e-6);
    EXPECT_FLOAT_EQ(std::accumulate(shares.begin(), shares.end(), 0.0f), 1);
}

TEST(GuidingChoice, TriesWhatFollowsTheFieldsWhileTheyLearn) {
    GuidingChoice choice = untried(1);
    // One bright walk by a field that knows little.
    const std::vector<WalkTallies> shown = agreeing({{walks(1000, 1, 2), walks(1000, 1, 20), walks(1000, 1e6, 4)}});
    choice.learn(shown, 15, true);
    EXPECT_FLOAT_EQ(choice.shares(0, 8)[directions], 1.0f / 8);
    EXPECT_LE(choice.shares(0, 8)[survival], 1.0f / 64) << "takes no directions";
    EXPECT_NEAR(choice.directed_share(8), 1.0 / 8, 1e-6);
    // A better field is soon believed.
    for (int pass = 0; pass < 8; ++pass) {
        choice.learn(agreeing({{walks(5000, 1, 2), walks(500, 1, 20), walks(500, 0.1, 4)}}), 31, true);
    }
    EXPECT_GT(choice.shares(0, 8)[directions], 0.9f);
}

TEST(GuidingChoice, DirectionsThatAreBeingLearnedAreTakenToGetBetter) {
    // Twice as dear as classical walks so far.
    const std::vector<WalkTallies> shown = agreeing({{walks(1000, 1, 1), walks(1000, 9, 1), walks(1000, 1, 2)}});
    GuidingChoice learning = untried(1), taught = untried(1);
    learning.learn(shown, 15, true);
    taught.learn(shown, 15, false);
    EXPECT_GT(learning.shares(0, 8)[directions], 0.9f);
    EXPECT_GT(taught.shares(0, 8)[classical_kind], 0.9f);
}

TEST(GuidingChoice, TheBestGuidedKindIsWatched) {
    // However dear it seemed.
    GuidingChoice choice = tried(1, {{walks(1000, 1, 1), walks(1000, 1, 200), walks(1000, 1, 100)}});
    EXPECT_EQ(choice.shares(0, 8), (WalkShares{1 - 1.0f / 64, 0, 1.0f / 64}));
    // By and by it shows what it is worth.
    for (int pass = 0; pass < 5; ++pass) {
        choice.learn(agreeing({{walks(10000, 1, 1), {}, walks(10000, 0.1, 2)}}), 31, false);
    }
    EXPECT_GT(choice.shares(0, 8)[directions], 0.9f);
}

TEST(GuidingChoice, KindsAreComparedInTheSameTiles) {
    // Where it is hard, walks are guided, where it is not they are classical; a few of the other kind show which is
    // better: guided ones have a quarter of the variance anywhere.
    const double hard = 100, easy = 1;
    const WalkTallies in_hard = {walks(100, hard, 2), walks(100, hard, 4), walks(1e5, hard / 4, 2)};
    const WalkTallies in_easy = {walks(1e5, easy, 2), walks(100, easy, 4), walks(100, easy / 4, 2)};
    const GuidingChoice choice = tried(2, {in_hard, in_easy});
    EXPECT_GT(choice.shares(0, 8)[directions], 0.9f);
    EXPECT_GT(choice.shares(1, 8)[directions], 0.9f);
    const auto means = choice.means();
    EXPECT_NEAR(means[classical_kind].square / means[directions].square, 4, 1e-3);
    EXPECT_NEAR(means[survival].work / means[directions].work, 2, 1e-3);
}

TEST(GuidingChoice, WhatHasFoundNothingIsNotTakenToBeExact) {
    WalkTally blind = walks(1000, 0, 1);
    blind.value = 0;
    GuidingChoice choice = untried(1);
    choice.learn(std::vector<WalkTallies>{{blind, blind, walks(1000, 5, 8, 5)}}, 15, false);
    EXPECT_EQ(choice.shares(0, 8)[directions], 1);
    // What lacks no more than a few bright walks may bring keeps its variance.
    WalkTally dim = walks(1000, 1, 1);
    dim.value = 850;
    EXPECT_GT(tried(1, {{dim, walks(1000, 5, 8), walks(1000, 5, 8)}}).shares(0, 8)[classical_kind], 0.8f);
}

TEST(GuidingChoice, TilesDifferWhereTheyHaveShownEnough) {
    const WalkTallies guided = {walks(1e5, 10, 3), walks(1e5, 9, 3), walks(1e5, 1, 3)};
    const WalkTallies unguided = {walks(1e5, 1, 3), walks(1e5, 9, 3), walks(1e5, 10, 3)};
    const GuidingChoice choice = tried(3, {guided, unguided, {}});
    EXPECT_GT(choice.shares(0, 8)[directions], 0.9f);
    EXPECT_GT(choice.shares(1, 8)[classical_kind], 0.9f);
    // Where nothing has been shown the picture counts: there both are alike.
    EXPECT_LT(choice.shares(2, 8)[survival], 0.07f);
}

TEST(GuidingChoice, RecordsTheMoreTheMoreGuidingBrings) {
    const auto share = [](double variance) {
        return tried(1, {{walks(1000, variance, 1), walks(1000, 1, 1), walks(1000, 1, 1)}}).recorded_share(8);
    };
    EXPECT_GT(share(0.1), 0);
    EXPECT_EQ(share(0.1), share(0.5));
    EXPECT_GT(share(2.5), share(0.5));
    EXPECT_LE(share(1e6), 1);
}

TEST(GuidingChoice, SamplesOfAPixelAreSpreadOverTheKindsInARow) {
    const WalkShares shares = {0.25f, 0.5f, 0.25f};
    for (std::uint64_t pixel = 0; pixel < 100; ++pixel) {
        std::array<int, most_walk_kinds> count{};
        std::size_t before = 0;
        for (int i = 0; i < 8; ++i) {
            const std::size_t kind = GuidingChoice::kind_of(shares, 1, pixel, i, 8);
            EXPECT_GE(kind, before);
            ++count[before = kind];
        }
        EXPECT_EQ(count, (std::array<int, most_walk_kinds>{2, 4, 2, 0}));
    }
}

TEST(GuidingChoice, SmallSharesHoldInTheMean) {
    const WalkShares shares = {0.97f, 0, 0.03f};
    constexpr int pixels = 40000, samples = 4;
    double rare = 0;
    for (std::uint64_t pixel = 0; pixel < pixels; ++pixel) {
        for (int i = 0; i < samples; ++i) {
            const std::size_t kind = GuidingChoice::kind_of(shares, 7, pixel, i, samples);
            ASSERT_NE(kind, survival);
            rare += kind == directions ? 1 : 0;
        }
    }
    EXPECT_NEAR(rare / (pixels * samples), 0.03, 0.002);
}

TEST(GuidingChoice, TeachesOnWhereGuidingBringsMuch) {
    const auto pays = [](double variance) {
        return tried(1, {{walks(1000, variance, 1), walks(1000, 1, 1), walks(1000, 1, 1)}}).guiding_pays();
    };
    EXPECT_FALSE(pays(1.5));
    EXPECT_TRUE(pays(3));
}

TEST(PixelWalks, KindsAreComparedInTheSamePixels) {
    // A hard pixel and an easy one. The first pass gives them as many walks, the second four times as many to the hard
    // one: both kinds are alike, and so are their tallies.
    const auto shown = [](int hard_walks, int easy_walks) {
        const double mean = (hard_walks + easy_walks) / 2.0;
        WalkTally tally;
        for (const auto& [count, spread] : {std::pair(hard_walks, 8.0f), std::pair(easy_walks, 1.0f)}) {
            PixelWalks pixel(1, mean / count);
            for (int i = 0; i < count; ++i) {
                const float x = 10 + (i % 2 == 0 ? spread : -spread);
                pixel.add(x, spread, static_cast<double>(x * x));
            }
            tally += pixel.tally();
        }
        return tally;
    };
    const WalkTally even = shown(4000, 4000), uneven = shown(6400, 1600);
    EXPECT_DOUBLE_EQ(uneven.walks, even.walks);
    EXPECT_NEAR(uneven.square / even.square, 1, 1e-3);
    EXPECT_NEAR(even.unguided / even.square, 1, 1e-9) << "of unguided walks";
    EXPECT_NEAR(uneven.unguided / uneven.square, 1, 1e-9);
    EXPECT_NEAR(uneven.value / even.value, 1, 1e-9);
    EXPECT_NEAR(uneven.work / even.work, 1, 1e-9);
}

TEST(PixelWalks, ShowTheVarianceByTheirScale) {
    PixelWalks walks(0.5);
    walks.add(3, 5, 20);
    EXPECT_EQ(walks.tally().walks, 0) << "one alone has none";
    walks.add(1, 6, 4);
    const WalkTally tally = walks.tally();
    EXPECT_EQ(tally.walks, 2);
    EXPECT_EQ(tally.value, 4);
    EXPECT_EQ(tally.spread, 2 * 2);
    EXPECT_EQ(tally.square, 2 * 0.5);
    EXPECT_EQ(tally.work, 11);
    // The mean of squares less the square of the mean, of which 3 · 1 is an estimate.
    EXPECT_EQ(tally.unguided, 2 * 0.25 * (12 - 3));
    EXPECT_EQ(tally.scaled(0.5).walks, 1);
    EXPECT_EQ(tally.scaled(0.5).square, 0.5);
}

}  // namespace
}  // namespace wend
