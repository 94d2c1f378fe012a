// Shares learned from what interior walks brought, on problems whose best shares are known.
#include <wend/core/random.h>
#include <wend/subsurface/technique_mixes.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace wend {
namespace {

const Box3 box(Vec3(0.0f), Vec3(1.0f));

/// f(x) = 3 x² on [0, 1], by technique 0 (density 1), 1 (3 x², which is perfect), and 2 (2 (1 - x), which is bad).
double density(std::size_t technique, double x) {
    return technique == 0 ? 1 : technique == 1 ? 3 * x * x : 2 * (1 - x);
}
double draw(std::size_t technique, double u) {
    return technique == 0 ? u : technique == 1 ? std::cbrt(u) : 1 - std::sqrt(1 - u);
}

InteriorWalkRecord interior_walk(const InteriorGuide::Shares& shares, Pcg32& random) {
    const double u = random.uniform_double();
    const std::size_t technique = u < shares[0] ? 0 : u < shares[0] + shares[1] ? 1 : 2;
    const double x = draw(technique, random.uniform_double());
    double mixture = 0;
    for (std::size_t i = 0; i < 3; ++i) {
        mixture += static_cast<double>(shares[i]) * density(i, x);
    }
    InteriorWalkRecord result{.medium = 0, .entry = Vec3(0.1f)};
    for (std::size_t i = 0; i < 3; ++i) {
        result.relative[i] = static_cast<float>(density(i, x) / mixture);
    }
    result.bring(static_cast<float>(3 * x * x / mixture), {result.relative, 0});
    return result;
}

TEST(TechniqueMixes, GiveTheSharesToWhatIsRight) {
    TechniqueMixes plans(box, {0.25f, 0.375f, 0.375f});
    Pcg32 random(1);
    const int cell = plans.cell_at(Vec3(0.1f));
    for (int round = 0; round < 8; ++round) {
        SecondMoments moments;
        for (int i = 0; i < 20000; ++i) {
            moments.add(cell, interior_walk(plans.plan(cell).shares, random));
        }
        plans.learn(moments.of(0), NextWalks::beside_classical);
    }
    const InteriorGuide::Shares& learned = plans.plan(cell).shares;
    EXPECT_GT(learned[1], 0.85f);
    EXPECT_EQ(learned[2], 0) << "what is useless is dropped";
    EXPECT_GE(learned[0], 0.029f) << "classical sampling bounds the weights";
    EXPECT_NEAR(learned[0] + learned[1] + learned[2], 1, 1e-5);
    // A cell where no interior walk began follows the others.
    EXPECT_GT(plans.plan(plans.cell_at(Vec3(0.9f))).shares[1], 0.85f);
}

TEST(TechniqueMixes, LeaveStaysToClassicalSamplingWhereGuidesDoNotPay) {
    for (const double spread : {0.1, 1.5}) {
        // Guided interior walks bring 1 and a bit, classical ones vary with a standard deviation that is smaller or
        // larger.
        TechniqueMixes plans(box, {0.25f, 0.75f});
        const int cell = plans.cell_at(Vec3(0.1f)), elsewhere = plans.cell_at(Vec3(0.9f));
        EXPECT_EQ(plans.plan(cell).unguided_probability, 0.0625f);
        Pcg32 random(1);
        const auto lesson = [&](NextWalks next) {
            SecondMoments moments;
            for (int i = 0; i < 4000; ++i) {
                InteriorWalkRecord one{.medium = 0, .entry = Vec3(0.1f)};
                one.guided = !(random.uniform() < plans.plan(cell).unguided_probability);
                one.flights = 4;
                one.relative = {1, 1};
                const float deviation = random.uniform() - 0.5f;
                one.bring(1 + (one.guided ? 1.0f : static_cast<float>(spread)) * deviation, {one.relative, 0});
                moments.add(cell, one);
            }
            plans.learn(moments.of(0), next);
        };
        const bool pays = spread > 1;
        lesson(NextWalks::beside_classical);
        const float probability = plans.plan(cell).unguided_probability;
        EXPECT_GT(probability, 0.01f);
        EXPECT_LE(probability, 0.0625f);
        EXPECT_EQ(plans.plan(elsewhere).unguided_probability, probability);
        lesson(NextWalks::rendering);
        EXPECT_EQ(plans.plan(cell).unguided_probability, pays ? 0 : 1);
        EXPECT_EQ(plans.plan(elsewhere).unguided_probability, pays ? 0 : 1);
    }
}

/// A lesson of 4000 interior walks, one in eight of them unguided, that bring 1 and a bit: `spread` times as much for
/// those as for the others, by a number in [0, 1) for each interior walk.
template <class F>
void teach(TechniqueMixes& plans, float spread, F&& number, NextWalks next) {
    SecondMoments moments;
    for (int i = 0; i < 4000; ++i) {
        InteriorWalkRecord one{.medium = 0, .entry = Vec3(0.1f)};
        one.guided = i % 8 > 0;
        one.flights = 4;
        one.relative = {1, 1};
        one.bring(1 + (one.guided ? 1 : spread) * (number(i) - 0.5f), {one.relative, 0});
        moments.add(plans.cell_at(one.entry), one);
    }
    plans.learn(moments.of(0), next);
}

TEST(TechniqueMixes, JudgeTheLearnedFieldByItsOwnStays) {
    for (const float spread : {0.2f, 6.0f}) {
        TechniqueMixes plans(box, {0.25f, 0.75f});
        Pcg32 random(1);
        const auto lesson = [&](float unguided_spread, NextWalks next) {
            teach(
                plans, unguided_spread, [&](int) { return random.uniform(); }, next);
        };
        // Whatever classical interior walks were like.
        lesson(1.2f - spread / 6, NextWalks::beside_classical);
        EXPECT_TRUE(plans.plan(0).is_unguided_classical);
        lesson(1.2f - spread / 6, NextWalks::beside_field);
        EXPECT_FALSE(plans.plan(0).is_unguided_classical);
        lesson(spread, NextWalks::rendering);
        EXPECT_EQ(plans.plan(0).unguided_probability, spread > 1 ? 0 : 1);
    }
}

// What can happen in an interior walk, how likely by each technique, and what it is worth.
struct Outcome {
    std::array<float, 3> density;
    float value;

    float mixed(const InteriorGuide::Shares& shares) const {
        return shares[0] * density[0] + shares[1] * density[1] + shares[2] * density[2];
    }
    /// Drawn with these shares; what is weighted against connections does not fall where the density grows.
    InteriorWalkRecord drawn(const InteriorGuide::Shares& shares, bool connected) const {
        const float p = mixed(shares);
        InteriorWalkRecord interior_walk{.medium = 0, .entry = Vec3(0.1f), .flights = 8};
        interior_walk.relative = {density[0] / p, density[1] / p, density[2] / p};
        interior_walk.bring(value / p, {connected ? InteriorGuide::Shares{} : interior_walk.relative, 0});
        return interior_walk;
    }
};

TEST(SecondMoments, TellTheErrorWithoutATechnique) {
    const InteriorGuide::Shares shares{0.2f, 0.5f, 0.3f};
    const std::array<Outcome, 3> outcomes = {Outcome{{0.5f, 0.8f, 0.1f}, 2}, Outcome{{0.25f, 0.1f, 0.1f}, 0.3f},
                                             Outcome{{0.25f, 0.1f, 0.8f}, 1}};
    for (const bool connected : {false, true}) {
        for (const std::size_t left_out : {1, 2}) {
            InteriorGuide::Shares others = shares;
            others[left_out] = 0;
            SecondMoments moments;
            double expected = 0;
            for (const Outcome& outcome : outcomes) {
                const InteriorWalkRecord interior_walk = outcome.drawn(shares, connected);
                const int times = static_cast<int>(std::lround(100 * outcome.mixed(shares)));
                for (int i = 0; i < times; ++i) {
                    moments.add(0, interior_walk, shares);
                }
                const double density = outcome.mixed(others) / (1 - shares[left_out]);
                const double brought = connected ? interior_walk.brought : outcome.value / density;
                expected += density * (brought - 1) * (brought - 1);
            }
            EXPECT_NEAR(moments.of(0).at(0).errors_without[left_out] / 100, expected, 1e-5 * expected);
        }
    }
}

TEST(TechniqueMixes, DropAStrategyThatOthersCanReplace) {
    // Two strategies find the same half of what there is, or a half each.
    for (const bool alike : {false, true}) {
        TechniqueMixes plans(box, {0.25f, 0.375f, 0.375f});
        const std::array<Outcome, 3> outcomes = {Outcome{{0.1f, 0.9f, alike ? 0.9f : 0.05f}, 0.5f},
                                                 Outcome{{0.1f, 0.05f, alike ? 0.05f : 0.9f}, 0.5f},
                                                 Outcome{{0.8f, 0.05f, 0.05f}, 0.1f}};
        const auto in_use = [&] {
            return (plans.plan(0).shares[1] > 0 ? 1 : 0) + (plans.plan(0).shares[2] > 0 ? 1 : 0);
        };
        Pcg32 random(1);
        for (int i = 0; i < 8; ++i) {
            const InteriorGuide::Shares shares = plans.plan(0).shares;
            SecondMoments moments;
            for (int k = 0; k < 20000; ++k) {
                float u = random.uniform();
                std::size_t which = 0;
                for (; which < 2 && u >= outcomes[which].mixed(shares); ++which) {
                    u -= outcomes[which].mixed(shares);
                }
                moments.add(plans.cell_at(Vec3(0.1f)), plans.relative(outcomes[which].drawn(shares, false)), shares);
            }
            plans.learn(moments.of(0), NextWalks::beside_classical);
            EXPECT_TRUE(i > 0 || in_use() == 2) << "the first stays are not relative to anything";
        }
        EXPECT_EQ(in_use(), alike ? 1 : 2);
    }
}

TEST(TechniqueMixes, InDoubtRenderByTheFieldThatHasJustLearnedMore) {
    struct Case {
        NextWalks seen;
        float spread;  ///< of unguided interior walks, over that of the guided ones
        float unguided;
    };
    // The variance counts times the cost: of 4 flights and 2 outside, 12 to 10.8 by the field and 6 to 10.8 of
    // classical sampling. Of logarithms so small 0.06 is within a deviation.
    for (const Case& c : {Case{NextWalks::beside_field, 0.90f, 1}, Case{NextWalks::beside_field, 0.965f, 1},
                          Case{NextWalks::beside_field, 1.10f, 0}, Case{NextWalks::beside_classical, 1.32f, 1},
                          Case{NextWalks::beside_classical, 1.36f, 0}}) {
        TechniqueMixes plans(box, {0.25f, 0.75f});
        const auto lesson = [&](NextWalks next) {
            // Evenly spread, so that nothing is left to chance.
            teach(
                plans, c.spread, [](int i) { return (static_cast<float>(i / 8) + 0.5f) / 500; }, next);
        };
        lesson(NextWalks::beside_classical);
        lesson(c.seen);
        lesson(NextWalks::rendering);
        EXPECT_EQ(plans.plan(0).unguided_probability, c.unguided) << c.spread;
    }
}

TEST(TechniqueMixes, GiveUpGuidesThatMissLightAsSoonAsTheFieldFindsIt) {
    for (const bool guides_miss : {false, true}) {
        TechniqueMixes plans(box, {0.25f, 0.75f});
        Pcg32 random(1);
        const auto lesson = [&](NextWalks next) {
            SecondMoments moments;
            for (int i = 0; i < 40000; ++i) {
                InteriorWalkRecord one{.medium = 0, .entry = Vec3(0.1f)};
                one.guided = i % 8 > 0;
                one.flights = 4;
                one.relative = {1, 1};
                // Both kinds bring 1 on average: one in values that all count in full, the other mostly in so large
                // ones that, cut off, they would seem to vary less.
                const float u = random.uniform();
                const bool misses = one.guided == guides_miss;
                one.bring(misses ? (u < 0.002f ? 400.0f : 0.2f) : (u < 0.25f ? 4.0f : 0.0f), {one.relative, 0});
                moments.add(plans.cell_at(one.entry), plans.relative(one));
            }
            plans.learn(moments.of(0), next);
        };
        lesson(NextWalks::beside_classical);
        lesson(NextWalks::beside_field);
        EXPECT_LE(plans.plan(0).unguided_probability, 0.0625f) << "classical stays are no measure";
        lesson(NextWalks::beside_field);
        EXPECT_EQ(plans.plan(0).unguided_probability == 1, guides_miss);
        lesson(NextWalks::rendering);
        EXPECT_EQ(plans.plan(0).unguided_probability, guides_miss ? 1 : 0);
    }
}

TEST(TechniqueMixes, CountWhatIsBroughtRelativeToWhatIsExpectedAndBoundIt) {
    TechniqueMixes plans(box, {0.25f, 0.75f});
    const auto brings = [](const Vec3& entry, float light) {
        InteriorWalkRecord interior_walk{.medium = 0, .entry = entry, .relative = {1, 2}};
        interior_walk.bring(light, {{1, 2}, -0.5f});
        return interior_walk;
    };
    EXPECT_EQ(plans.relative(brings(Vec3(0.1f), 5)).brought, 5) << "nothing is expected yet";
    SecondMoments moments;
    constexpr int many = 100000;
    for (int i = 0; i < many; ++i) {
        for (const float x : {0.1f, 0.9f}) {
            const InteriorWalkRecord interior_walk = brings(Vec3(x), x);
            moments.add(plans.cell_at(interior_walk.entry), plans.relative(interior_walk));
        }
    }
    plans.learn(moments.of(0), NextWalks::beside_classical);
    for (const float x : {0.1f, 0.9f}) {
        const InteriorWalkRecord twice = plans.relative(brings(Vec3(x), 2 * x));
        EXPECT_NEAR(twice.brought, 2, 0.01f);
        EXPECT_NEAR(twice.slope.shares[1], 4, 0.02f);
        EXPECT_NEAR(twice.slope.preference, -1, 0.005f);
        const InteriorWalkRecord rare = plans.relative(brings(Vec3(x), 1000 * x));
        EXPECT_NEAR(rare.brought, 30, 0.15f);
        EXPECT_NEAR(rare.slope.shares[1], 60, 0.3f);
    }
    EXPECT_NEAR(plans.relative(brings(Vec3(0.5f), 1)).brought, 2, 0.01f) << "the mean, where nothing was seen";
}

TEST(TechniqueMixes, HardlyConnectWhereNothingIsEverConnected) {
    for (const bool connects : {false, true}) {
        const InteriorGuide::Shares shares{0.25f, 0.75f};
        TechniqueMixes plans(box, shares);
        const int cell = plans.cell_at(Vec3(0.1f));
        EXPECT_GT(plans.plan(cell).guided.probability, 0.4f);
        Pcg32 random(1);
        SecondMoments moments;
        for (int i = 0; i < 5000; ++i) {
            InteriorWalkRecord one = interior_walk(shares, random);
            one.connected = connects && i == 0;
            one.connected_through = !connects && i == 0;
            moments.add(cell, one);
        }
        plans.learn(moments.of(0), NextWalks::beside_classical);
        plans.learn({}, NextWalks::beside_classical);
        const float probability = plans.plan(cell).guided.probability;
        EXPECT_GT(probability, 0);
        EXPECT_EQ(probability < 0.1f, !connects);
        // Straight connections and those that boundaries refract, each for itself.
        const float through_boundaries = plans.plan(cell).guided.through_boundaries;
        EXPECT_GT(through_boundaries, 0);
        EXPECT_EQ(through_boundaries < 0.01f, connects);
    }
}

TEST(TechniqueMixes, LearnNothingFromNothingOrFromWhatIsNotANumber) {
    const InteriorGuide::Shares start{0.25f, 0.75f};
    TechniqueMixes plans(box, start);
    SecondMoments moments;
    plans.learn(moments.of(0), NextWalks::beside_classical);
    InteriorWalkRecord bad{.medium = 0, .entry = Vec3(0.5f)};
    bad.relative = {1, 1};
    bad.bring(std::numeric_limits<float>::quiet_NaN(), {bad.relative, 0});
    moments.add(plans.cell_at(bad.entry), bad);
    plans.learn(moments.of(0), NextWalks::beside_classical);
    EXPECT_EQ(plans.plan(0).shares, start);
}

TEST(TechniqueMixes, MomentsAddUp) {
    Pcg32 random(2);
    SecondMoments all, first, second;
    for (int i = 0; i < 100; ++i) {
        const InteriorWalkRecord one = interior_walk({0.5f, 0.5f}, random);
        all.add(i % 7, one);
        (i < 50 ? first : second).add(i % 7, one);
    }
    first += second;
    for (const auto& [cell, sums] : all.of(0)) {
        EXPECT_NEAR(first.of(0).at(cell).guided.powers[4], sums.guided.powers[4], 1e-9 * sums.guided.powers[4]);
        EXPECT_NEAR(first.of(0).at(cell).slopes[1], sums.slopes[1], 1e-9 * sums.guided.powers[2]);
    }
    EXPECT_TRUE(all.of(1).empty());
}

}  // namespace
}  // namespace wend
