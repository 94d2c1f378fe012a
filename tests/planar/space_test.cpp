#include <tests/support/chi_square_sphere.h>
#include <wend/medium/phase.h>
#include <wend/planar/modal_decisions.h>
#include <wend/planar/space.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

/// A source that falls with depth and prefers one side.
PlanarAdjoint tilted_adjoint() {
    PlanarSlab slab;
    slab.near.illumination = [](double cosine) { return 0.5 + cosine; };
    PlanarModes modes;
    modes.modes.push_back({2.0, 0.5, 0, {1, -0.3}});
    modes.modes.push_back({0.4, 0.2, 0, {1, 0.2}});
    return {modes, slab};
}

TEST(PlanarSpace, DirectionsFollowBoostTimesPhaseFunction) {
    const PlanarAdjoint adjoint = tilted_adjoint();
    const Vec3 inward = normalize(Vec3(0.3f, -0.5f, 0.8f));
    const struct {
        double g;
        Vec3 before;
    } cases[] = {{0.0, Vec3(1, 0, 0)}, {0.7, normalize(Vec3(1, 2, -1))}, {-0.5, inward}, {0.5, -inward}};
    int number = 0;
    for (const auto& arrival : cases) {
        // Lambdas capture these, as clang 14 does not let them capture a structured binding.
        const double g = arrival.g;
        const Vec3 before = arrival.before;
        const ModalDirection decision(adjoint, g);
        const HenyeyGreenstein phase{static_cast<float>(g)};
        const double depth = 0.3;
        const auto density = [&](const Vec3& w) {
            return density_ratio_in_space(decision, depth, before, w, inward) *
                   static_cast<double>(phase.evaluate(dot(before, w)));
        };
        const auto sample = [&](Pcg32& random) {
            return std::optional<Vec3>(sample_in_space(decision, g, depth, before, inward, random).direction);
        };
        const auto name = "planar_space_" + std::to_string(number++);
        EXPECT_TRUE(test::follows_density(test::test_direction_sampler(sample, density), name, 4));
        // The phase function alone is another density.
        const auto wrong = [&](const Vec3& w) { return static_cast<double>(phase.evaluate(dot(before, w))); };
        EXPECT_FALSE(test::follows_density(test::test_direction_sampler(sample, wrong), name + "_wrong"));
    }
}

}  // namespace
}  // namespace wend
