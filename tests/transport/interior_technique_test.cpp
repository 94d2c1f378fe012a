// The interior technique: what the path tracer asks of it is what the interior walk answers, wherever the path is.
#include <tests/support/scenes.h>
#include <wend/decision/distance.h>
#include <wend/stats/moments.h>
#include <wend/stats/significance.h>
#include <wend/transport/path_decisions.h>
#include <wend/transport/path_technique.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

/// A ball of dense murk under a white sky.
SceneDescription ball() {
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, Rgb(1.0f), Rgb(19.0f), 0.3f);
    test::add_sphere(s, {0, 0, 0}, 1, test::add_interface(s), medium);
    test::add_environment(s, Rgb(1.0f));
    return s;
}

class InteriorTechniqueTest : public testing::Test {
protected:
    /// Enters the ball from the left, straight towards its middle.
    InteriorTechnique entered() const {
        const Ray ray{{-2, 0, 0}, {1, 0, 0}};
        InteriorTechnique technique;
        technique.enter(guides_, 0, *scene_.intersect(ray), ray.direction, Rgb(1.0f));
        return technique;
    }

    Scene scene_{ball()};
    SubsurfaceGuides guides_{scene_, parse_subsurface("auto")};
    ClassicalDecisions decisions_;
};

TEST_F(InteriorTechniqueTest, IsWhereTheGuidesAre) {
    EXPECT_EQ(InteriorTechnique().walk().guide(), nullptr);
    const InteriorTechnique technique = entered();
    ASSERT_NE(technique.walk().guide(), nullptr);
    EXPECT_EQ(technique.walk().guide()->medium.extinction(), Rgb(20.0f));
    EXPECT_TRUE(technique.walk().is_guided());
}

TEST_F(InteriorTechniqueTest, ChoosesByTheMix) {
    EXPECT_TRUE(std::holds_alternative<FieldTechnique>(technique_of(nullptr, false)));
    TechniqueMix mix;
    EXPECT_TRUE(std::holds_alternative<InteriorTechnique>(technique_of(&mix, true)));
    EXPECT_TRUE(std::holds_alternative<ClassicalTechnique>(technique_of(&mix, false)));
    mix.is_unguided_classical = false;
    EXPECT_TRUE(std::holds_alternative<FieldTechnique>(technique_of(&mix, false)));
    EXPECT_EQ(interior_of(technique_of(&mix, false)), nullptr);
}

TEST_F(InteriorTechniqueTest, ConnectionsKnowFlightsFromCollisionsAlone) {
    Sampler sampler(SamplerKind::independent, 1, 0, 0);
    InteriorTechnique technique = entered();
    EXPECT_FALSE(technique.fly(0.01f, 1).pass_probability) << "the first flight, which no collision began";
    const Vertex v = Vertex::in_medium({-0.9f, 0, 0});
    const PhaseFunction phase(HenyeyGreenstein{0.3f});
    const VolumeScattering f(phase, {1, 0, 0});
    const auto& directions = technique.directions(decisions_, f, v, 1, sampler.random());
    technique.turn(directions, directions.sample(0.3f, {0.2f, 0.7f})->direction);
    const TechniqueFlight passed = technique.fly(0.01f, 1);
    ASSERT_TRUE(passed.pass_probability);
    EXPECT_FALSE(passed.flight.scatters);
    EXPECT_GT(*passed.pass_probability, 0.5f);
    EXPECT_LT(*passed.pass_probability, 1);
    technique.head({0, 1, 0});
    EXPECT_FALSE(technique.fly(0.01f, 1).pass_probability) << "a boundary has turned it";
}

// What a path finds on a way of one collision and a flight is the same however it is drawn: what is scattered there,
// and comes through.
TEST_F(InteriorTechniqueTest, WeightsAreThoseOfTheMedium) {
    constexpr float first = 0.05f, then = 0.03f, extinction = 20, albedo = 0.95f, g = 0.3f;
    const PhaseFunction phase(HenyeyGreenstein{g});
    Moments reached, biased;
    Sampler sampler(SamplerKind::independent, 3, 0, 0);
    for (int i = 0; i < 200000; ++i) {
        InteriorTechnique technique = entered();
        const Flight flight = technique.fly(first, technique.draw_distance(sampler)).flight;
        float value = 0;
        if (flight.scatters) {
            const Vertex v = Vertex::in_medium({-1 + flight.distance, 0, 0});
            const VolumeScattering f(phase, {1, 0, 0});
            const auto& directions = technique.directions(decisions_, f, v, 1, sampler.random());
            const float u = sampler.random().uniform();
            const auto s = directions.sample(u, sampler.random().uniform2());
            technique.turn(directions, s->direction);
            const Flight next = technique.fly(then, technique.draw_distance(sampler)).flight;
            // The mean of 1 + w · x over the phase function is 1 + g.
            value = next.scatters ? 0.0f : flight.weight.g * s->weight().g * next.weight.g * (1 + s->direction.x);
        }
        reached.add(value);
        biased.add(1.02 * value);
    }
    const double expected = albedo * -std::expm1(-extinction * first) * (1 + g) * std::exp(-extinction * then);
    EXPECT_TRUE(agrees(reached, expected, 4, 1e-5)) << reached.mean() << " expected " << expected;
    EXPECT_FALSE(agrees(biased, expected, 4, 1e-5)) << "a bias of 2 % must be seen";
}

TEST_F(InteriorTechniqueTest, ShowsItselfTowardsALightAndStaysWhereItIs) {
    Sampler sampler(SamplerKind::independent, 5, 0, 0);
    InteriorTechnique technique = entered();
    const PhaseFunction phase(HenyeyGreenstein{0.3f});
    const auto& directions = technique.directions(decisions_, VolumeScattering(phase, {1, 0, 0}),
                                                  Vertex::in_medium({-0.9f, 0, 0}), 1, sampler.random());
    const auto before = technique.walk().relative_densities();
    InteriorWalk there = directions.towards({-1, 0, 0});
    EXPECT_GT(there.relative_densities()[1], before[1]) << "out to the boundary is where the guide goes";
    EXPECT_EQ(technique.walk().relative_densities(), before);
    technique.turn(directions, {-1, 0, 0});
    EXPECT_EQ(technique.walk().relative_densities(), there.relative_densities());
    EXPECT_EQ(technique.pass(0.02f), there.pass(0.02f));
}

}  // namespace
}  // namespace wend
