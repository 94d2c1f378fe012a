#include <wend/medium/phase.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

/// The largest ratio of two functions of the angle to +z, either way round, over the sphere. Angles are dense where
/// either has a peak.
template <class Phase>
double worst_ratio(const Phase& phase, const AxialLobes& lobes) {
    double worst = 1;
    for (int i = 0; i <= 4000; ++i) {
        const double angle = 1e-5 * std::pow(pi / 2 / 1e-5, i / 4000.0);
        for (const double a : {0.0, angle, pi - angle, static_cast<double>(pi)}) {
            const Vec3 w(static_cast<float>(std::sin(a)), 0, static_cast<float>(std::cos(a)));
            const double ratio = lobes.density(w) / static_cast<double>(phase.evaluate(w.z));
            worst = std::max({worst, ratio, 1 / ratio});
        }
    }
    return worst;
}

double stated_ratio(float g) {
    const float a = std::abs(g);
    return a <= 0.9f ? 1.022 : a <= 0.95f ? 1.065 : a <= 0.98f ? 1.17 : 1.29;
}

TEST(PhaseLobes, StayWithinTheStatedRatioOverTheWholeSphere) {
    for (int i = 0; i <= 99; ++i) {
        for (const float g : {0.01f * static_cast<float>(i), -0.01f * static_cast<float>(i)}) {
            EXPECT_LT(worst_ratio(HenyeyGreenstein{g}, HenyeyGreenstein{g}.lobes()), stated_ratio(g)) << g;
        }
    }
}

TEST(PhaseLobes, TheNextFunctionIsRejected) {
    for (const float g : {0.05f, 0.3f, 0.7f, 0.9f, -0.9f}) {
        EXPECT_GT(worst_ratio(HenyeyGreenstein{g}, HenyeyGreenstein{g + 0.02f}.lobes()), stated_ratio(g)) << g;
    }
}

TEST(PhaseLobes, AnIsotropicFunctionIsOneUniformLobe) {
    const AxialLobes lobes = HenyeyGreenstein{0}.lobes();
    EXPECT_EQ(lobes.size(), 1);
    EXPECT_EQ(lobes.kappa(0), 0);
    EXPECT_FLOAT_EQ(lobes.amplitude(0), inv_4pi);
}

TEST(PhaseLobes, AMixtureHasTheLobesOfItsParts) {
    HenyeyGreensteinMixture two;
    two.add(3, 0.9f);
    two.add(1, -0.5f);
    EXPECT_LT(worst_ratio(two, two.lobes()), stated_ratio(0.9f));
    HenyeyGreensteinMixture four = two;
    four.add(2, 0.99f);
    four.add(5, -0.97f);
    EXPECT_LT(worst_ratio(four, four.lobes()), stated_ratio(0.99f));
    EXPECT_GT(worst_ratio(four, two.lobes()), 2);
}

/// The largest ratio over the least.
double spread(const Draine& phase) {
    const AxialLobes lobes = phase.lobes();
    double least = 1e9, most = 0;
    for (int i = 0; i <= 4000; ++i) {
        const double angle = pi * i / 4000;
        const Vec3 w(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
        const double ratio = lobes.density(w) / static_cast<double>(phase.evaluate(w.z));
        least = std::min(least, ratio);
        most = std::max(most, ratio);
    }
    return most / least;
}

TEST(PhaseLobes, FollowDraineWithinTheStatedFactor) {
    for (const float g : {0.0f, 0.05f, -0.3f, 0.7f, 0.9f}) {
        EXPECT_LT(worst_ratio(Draine(g, 0), Draine(g, 0).lobes()), stated_ratio(g)) << g;
        const double beside = sqr(stated_ratio(g));
        EXPECT_LT(spread(Draine(g, 1)), 1.03 * beside) << g;
        EXPECT_LT(spread(Draine(g, 40)), 2.5 * beside) << g;
        EXPECT_LT(spread(Draine(g, 250)), 7.2 * beside) << g;
        EXPECT_GT(worst_ratio(Draine(g, 1), HenyeyGreenstein{g}.lobes()), 1.3) << g;
    }
}

TEST(PhaseLobes, WhatIsMorePeakedThanTheTableGetsItsLastPicture) {
    EXPECT_EQ(HenyeyGreenstein{0.999f}.lobes().amplitude(0), HenyeyGreenstein{0.99f}.lobes().amplitude(0));
}

TEST(PhaseLobes, LieAlongTheDirectionOfPropagation) {
    const Vec3 before = normalize(Vec3(1, 2, -2));
    const PhaseFunction phase(HenyeyGreenstein{-0.6f});
    for (const Vec3& w : {before, -before, normalize(Vec3(1, 0, 1))}) {
        const float exact = phase.evaluate(dot(before, w));
        EXPECT_NEAR(phase.lobes(before).density(w), exact, 0.022f * exact);
    }
}

}  // namespace
}  // namespace wend
