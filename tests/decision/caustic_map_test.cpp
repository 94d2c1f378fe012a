// Directions that photons know: the cells of caustic lobes, and what is drawn from them.
#include <tests/support/chi_square_sphere.h>
#include <wend/core/random.h>
#include <wend/decision/caustic_map.h>
#include <wend/decision/direction.h>
#include <wend/sampling/warp.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

/// Scatters evenly into the upper half of directions.
struct UpperHalf {
    Rgb evaluate(const Vec3& w) const { return Rgb(w.z > 0 ? 1 / (2 * pi) : 0.0f); }
};

const Vec3 bright = normalize(Vec3(0.3f, 0.2f, 0.9f)), faint = normalize(Vec3(-0.8f, 0.1f, 0.5f));

/// On the unit square at z = 0: two lamps of a given angular size, of which one photon in `ratio` comes from the faint
/// one.
std::vector<CausticLobe> two_lamps(int n, int ratio, float size) {
    std::vector<CausticLobe> caustics;
    Pcg32 random(1);
    for (int i = 0; i < n; ++i) {
        const Vec2 u = random.uniform2();
        const Vec2 across = to_disk(random.uniform2()) * size;
        const bool is_faint = i % ratio == 0;
        const Frame frame = Frame::from_z(is_faint ? faint : bright);
        caustics.push_back({{u.x, u.y, 0},
                            normalize(frame.to_world({across.x, across.y, 1})),
                            is_faint ? 7.0f : 5.0f,
                            Rgb(2.0f, 1.0f, 0.0f)});
    }
    return caustics;
}

Vec3 place(Pcg32& random) {
    const Vec2 u = random.uniform2();
    return {u.x, u.y, 0};
}

TEST(CausticLobes, NothingIsKnownOfNone) {
    EXPECT_EQ(CausticMap().find({0, 0, 0}), nullptr);
    EXPECT_EQ(CausticMap(std::vector<CausticLobe>()).find({0, 0, 0}), nullptr);
    EXPECT_EQ(CausticMap().size(), 0u);
}

TEST(CausticLobes, OneAloneIsKnownWhereItArrived) {
    const CausticMap map({{{1, 2, 3}, bright, 4, Rgb(1.0f)}});
    const CausticMap::Cell* cell = map.find({1, 2, 3});
    ASSERT_NE(cell, nullptr);
    EXPECT_EQ(cell->count, 1u);
    EXPECT_NEAR(dot(cell->groups[0].lobe.mean, bright), 1, 1e-6f);
    EXPECT_GT(cell->groups[0].lobe.kappa, 0);
    EXPECT_EQ(map.find({1, 2, 4}), nullptr);
}

TEST(CausticLobes, ThoseThatAreNotWorthItAreLeftOut) {
    const CausticMap map(two_lamps(4000, 3, 0.02f));
    const CausticMap kept = map.keeping(
        [](const CausticMap::Cell&, const CausticMap::Group& group) { return dot(group.lobe.mean, faint) > 0.9f; });
    Pcg32 random(3);
    int found = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 p = place(random);
        const CausticMap::Cell *cell = kept.find(p), *all = map.find(p);
        if (!cell || cell->bright == 0) {
            continue;
        }
        ++found;
        ASSERT_NE(all, nullptr);
        ASSERT_GE(cell->bright, 1u);
        EXPECT_LT(cell->light, all->light);
        float light = 0;
        for (std::size_t g = 0; g < cell->bright; ++g) {
            EXPECT_GT(dot(cell->groups[g].lobe.mean, faint), 0.9f);
            light += mean_value(cell->groups[g].light);
        }
        EXPECT_FLOAT_EQ(cell->light, light);
    }
    EXPECT_GT(found, 900);
    const CausticMap none = map.keeping([](const CausticMap::Cell&, const CausticMap::Group&) { return false; });
    EXPECT_EQ(none.size(), 0u);
    EXPECT_EQ(none.find({0.5f, 0.5f, 0}), nullptr);
}

TEST(CausticLobes, LightIsNeitherLostNorMade) {
    constexpr int n = 10000;
    const CausticMap map(two_lamps(n, 10, 0.02f));
    EXPECT_EQ(map.size(), static_cast<std::size_t>(n));
    Pcg32 random(2);
    double sum = 0;
    constexpr int places = 20000;
    for (int i = 0; i < places; ++i) {
        const CausticMap::Cell* cell = map.find(place(random));
        ASSERT_NE(cell, nullptr);
        EXPECT_LE(cell->count, CausticMap::most_groups);
        ASSERT_LE(cell->bright, cell->count);
        const auto end = cell->groups.begin() + static_cast<std::ptrdiff_t>(cell->bright);
        const float light =
            std::accumulate(cell->groups.begin(), end, 0.0f,
                            [](float all, const CausticMap::Group& group) { return all + mean_value(group.light); });
        EXPECT_NEAR(light, cell->light, 1e-4f * cell->light);
        sum += static_cast<double>(cell->fluence(false));
    }
    EXPECT_NEAR(sum / places, n, 0.02 * n);
}

TEST(CausticLobes, NoLampIsLeftOut) {
    const CausticMap map(two_lamps(4096, 16, 0.02f));
    Pcg32 random(3);
    int found = 0;
    constexpr int places = 2000;
    for (int i = 0; i < places; ++i) {
        const CausticMap::Cell* cell = map.find(place(random));
        ASSERT_NE(cell, nullptr);
        float light = 0;
        for (std::size_t g = 0; g < cell->count; ++g) {
            const CausticMap::Group& group = cell->groups[g];
            const bool is_faint = dot(group.lobe.mean, faint) > 0.99f;
            EXPECT_TRUE(is_faint || dot(group.lobe.mean, bright) > 0.99f) << "a group of two lamps";
            EXPECT_NEAR(group.distance, is_faint ? 7 : 5, 1e-4f);
            EXPECT_NEAR(group.light.r, 2 * group.light.g, 1e-4f);
            light += is_faint && g < cell->bright ? mean_value(group.light) : 0.0f;
        }
        found += light > 0 ? 1 : 0;
    }
    // Two of 32 come from it: of a random choice of eight, more than half would have none.
    EXPECT_GT(found, places * 4 / 5);
}

TEST(CausticLobes, LobesAreAsWideAsLampsLook) {
    constexpr float size = 0.05f;
    const CausticMap map(two_lamps(4096, 2, size));
    Pcg32 random(4);
    for (int i = 0; i < 100; ++i) {
        const Vec3 here = place(random);
        const CausticMap::Cell* cell = map.find(here);
        ASSERT_NE(cell, nullptr);
        const CausticLobeMixture mixture(*cell, here, UpperHalf());
        // The mean density over the lamp is near that of a disc; a wide lobe or gaps between narrow ones miss it.
        double sum = 0;
        constexpr int n = 4000;
        for (int k = 0; k < n; ++k) {
            const Vec2 across = to_disk(random.uniform2()) * size;
            sum += static_cast<double>(
                mixture.density(normalize(Frame::from_z(bright).to_world({across.x, across.y, 1}))));
        }
        const double disc = 0.5 / static_cast<double>(pi * size * size);
        EXPECT_GT(sum / n, 0.4 * disc);
        EXPECT_LT(sum / n, 2.5 * disc);
    }
}

TEST(CausticLobes, DirectionsTurnWithThePlace) {
    // A lamp that is seen in a lens: it seems to be closer than its light has come.
    const Vec3 picture(0.4f, 0.6f, 1.5f);
    std::vector<CausticLobe> caustics;
    Pcg32 random(5);
    for (int i = 0; i < 2000; ++i) {
        const Vec3 position = place(random);
        caustics.push_back({position, normalize(picture - position), 4, Rgb(1.0f)});
    }
    const CausticMap map(caustics);
    Moments turned, unturned;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 position = place(random);
        const CausticMap::Cell* cell = map.find(position);
        ASSERT_NE(cell, nullptr);
        const Vec3 towards = normalize(picture - position);
        const auto closest = [&](const auto& direction) {
            float best = 2;
            for (std::size_t g = 0; g < cell->count; ++g) {
                best = std::min(best, length(direction(cell->groups[g]) - towards));
            }
            return best;
        };
        turned.add(closest([&](const CausticMap::Group& group) { return group.direction(position); }));
        unturned.add(closest([](const CausticMap::Group& group) { return group.lobe.mean; }));
    }
    EXPECT_LT(turned.mean(), 0.6 * unturned.mean());
}

TEST(CausticLobes, WhatIsTooFaintIsNotDividedBy) {
    std::vector<CausticLobe> caustics(20, {{0, 0, 0}, bright, 4, Rgb(1.0f)});
    caustics.push_back({{0, 0, 0}, faint, 4, Rgb(1e-30f)});
    const CausticMap map(caustics);
    const CausticMap::Cell* cell = map.find({0, 0, 0});
    ASSERT_NE(cell, nullptr);
    EXPECT_EQ(cell->count, 1u);
    const CausticLobeMixture mixture(*cell, {0, 0, 0}, UpperHalf());
    ASSERT_FALSE(mixture.is_empty());
    EXPECT_GT(mixture.density(bright), 1.0f);
    EXPECT_TRUE(std::isfinite(mixture.density(faint)));
}

TEST(CausticLobes, ASkyIsLeftToOthers) {
    std::vector<CausticLobe> caustics;
    Pcg32 random(6);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 position = place(random);
        caustics.push_back({position, to_sphere(random.uniform2()), 4, Rgb(1.0f)});
    }
    const CausticMap map(caustics);
    int drawn = 0;
    for (int i = 0; i < 1000; ++i) {
        const Vec3 position = place(random);
        const CausticMap::Cell* cell = map.find(position);
        ASSERT_NE(cell, nullptr);
        drawn += CausticLobeMixture(*cell, position, UpperHalf()).is_empty() ? 0 : 1;
    }
    EXPECT_LT(drawn, 500);
}

TEST(CausticLobes, NothingIsDrawnThatIsNotScattered) {
    const CausticMap map(std::vector<CausticLobe>(20, {{0, 0, 0}, {0, 0, -1}, 1, Rgb(1.0f)}));
    const CausticMap::Cell* cell = map.find({0, 0, 0});
    ASSERT_NE(cell, nullptr);
    EXPECT_TRUE(CausticLobeMixture().is_empty());
    EXPECT_TRUE(CausticLobeMixture(*cell, {0, 0, 0}, UpperHalf()).is_empty());
}

TEST(CausticLobes, SamplesFollowTheirDensity) {
    // As wide as a sphere's bins can tell.
    const CausticMap map(two_lamps(500, 3, 0.6f));
    const CausticMap::Cell* cell = map.find({0.4f, 0.6f, 0});
    ASSERT_NE(cell, nullptr);
    const CausticLobeMixture mixture(*cell, {0.4f, 0.6f, 0}, UpperHalf());
    const auto test = test::chi_square_sphere(
        [&](Pcg32& random) -> std::optional<Vec3> {
            const float u = random.uniform();
            return mixture.sample(u, random.uniform2());
        },
        [&](const Vec3& w) { return mixture.density(w); });
    EXPECT_TRUE(test::follows_density(test, "caustics", 1));
}

}  // namespace
}  // namespace wend
