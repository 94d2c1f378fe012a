// Shares learned from what interior walks brought, on problems whose best shares are known.
#include <wend/core/random.h>
#include <wend/subsurface/technique_mixes.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace wend {
namespace {

const Box3 box(Vec3(0.0f), Vec3(1.0f));

/// f(x) = 3 x² on [0, 1], by classical sampling (density 1), a perfect guide (3 x²), and a misled one (2 (1 - x)).
struct Guide {
    double (*density)(double x);
    double (*draw)(double u);
};
constexpr Guide classical{[](double) { return 1.0; }, [](double u) { return u; }};
const Guide perfect{[](double x) { return 3 * x * x; }, [](double u) { return std::cbrt(u); }};
const Guide misled{[](double x) { return 2 * (1 - x); }, [](double u) { return 1 - std::sqrt(1 - u); }};

InteriorWalkRecord interior_walk(const Guide& guide, float defensive_fraction, Pcg32& random) {
    const bool is_classical = random.uniform_double() < static_cast<double>(defensive_fraction);
    const double x = (is_classical ? classical : guide).draw(random.uniform_double());
    const double share = defensive_fraction;
    const double mixture = share * classical.density(x) + (1 - share) * guide.density(x);
    InteriorWalkRecord result{.medium = 0, .entry = Vec3(0.1f)};
    result.relative = {static_cast<float>(classical.density(x) / mixture),
                       static_cast<float>(guide.density(x) / mixture)};
    result.bring(static_cast<float>(3 * x * x / mixture), {result.relative, 0});
    return result;
}

float learned_fraction(const Guide& guide, const Vec3& where) {
    TechniqueMixes plans(box, 0.4f);
    Pcg32 random(1);
    const int cell = plans.cell_at(Vec3(0.1f));
    for (int round = 0; round < 8; ++round) {
        SecondMoments moments;
        for (int i = 0; i < 20000; ++i) {
            moments.add(cell, interior_walk(guide, plans.plan(cell).defensive_fraction, random));
        }
        plans.learn(moments.of(0), NextWalks::beside_classical);
    }
    return plans.plan(plans.cell_at(where)).defensive_fraction;
}

TEST(TechniqueMixes, GiveTheWalksToWhatIsRight) {
    EXPECT_LT(learned_fraction(perfect, Vec3(0.1f)), 0.1f);
    EXPECT_GE(learned_fraction(perfect, Vec3(0.1f)), 0.029f) << "classical sampling bounds the weights";
    EXPECT_LT(learned_fraction(perfect, Vec3(0.9f)), 0.1f) << "a cell where no walk began follows the others";
    EXPECT_EQ(learned_fraction(misled, Vec3(0.1f)), 1) << "what is useless is dropped";
}

TEST(TechniqueMixes, LeaveStaysToClassicalSamplingWhereGuidesDoNotPay) {
    for (const double spread : {0.1, 1.5}) {
        // Guided interior walks bring 1 and a bit, classical ones vary with a standard deviation that is smaller or
        // larger.
        TechniqueMixes plans(box, 0.25f);
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
        TechniqueMixes plans(box, 0.25f);
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
        TechniqueMixes plans(box, 0.25f);
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
        TechniqueMixes plans(box, 0.25f);
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
    TechniqueMixes plans(box, 0.25f);
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
        TechniqueMixes plans(box, 0.25f);
        const int cell = plans.cell_at(Vec3(0.1f));
        EXPECT_GT(plans.plan(cell).guided.probability, 0.4f);
        Pcg32 random(1);
        SecondMoments moments;
        for (int i = 0; i < 5000; ++i) {
            InteriorWalkRecord one = interior_walk(perfect, 0.25f, random);
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
    TechniqueMixes plans(box, 0.25f);
    SecondMoments moments;
    plans.learn(moments.of(0), NextWalks::beside_classical);
    InteriorWalkRecord bad{.medium = 0, .entry = Vec3(0.5f)};
    bad.relative = {1, 1};
    bad.bring(std::numeric_limits<float>::quiet_NaN(), {bad.relative, 0});
    moments.add(plans.cell_at(bad.entry), bad);
    plans.learn(moments.of(0), NextWalks::beside_classical);
    EXPECT_EQ(plans.plan(0).defensive_fraction, 0.25f);
}

TEST(TechniqueMixes, MomentsAddUp) {
    Pcg32 random(2);
    SecondMoments all, first, second;
    for (int i = 0; i < 100; ++i) {
        const InteriorWalkRecord one = interior_walk(perfect, 0.5f, random);
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
