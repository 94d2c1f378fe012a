// Guides of layers: what they draw follows what they tell, in and beyond the layer.
#include <tests/support/chi_square_sphere.h>
#include <wend/numeric/quadrature.h>
#include <wend/planar/lit_layers.h>
#include <wend/stats/significance.h>
#include <wend/subsurface/layer_guide.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

constexpr double extinction = 2;

struct Problem {
    const char* name;
    double albedo, g, ior;
    LayerPlace place;
};

void PrintTo(const Problem& problem, std::ostream* out) {
    *out << problem.name;
}

const Vec3 inward = normalize(Vec3(0.2f, -0.4f, 0.9f));

class GuideOfLayers : public testing::TestWithParam<Problem> {
protected:
    LayerGuide guide_{extinction, GetParam().g, lit_layers(GetParam().albedo, GetParam().g, GetParam().ior)};
    LayerPlace place_ = GetParam().place;
};

TEST_P(GuideOfLayers, DrawsDirectionsByTheirDensity) {
    for (const Vec3& before : {inward, normalize(Vec3(1, 0.3f, 0.1f))}) {
        const LayerGuide::Directions directions(guide_, place_, before);
        const auto sample = [&](Pcg32& random) { return std::optional<Vec3>(directions.sample(random)); };
        const auto density = [&](const Vec3& w) { return directions.density(w); };
        EXPECT_GT(test::test_direction_sampler(sample, density).result.p_value, 1e-4);
        const auto wrong = [&](const Vec3& w) { return directions.density(-w); };
        EXPECT_LT(test::test_direction_sampler(sample, wrong).result.p_value, 1e-6);
    }
}

TEST_P(GuideOfLayers, FlightsThatPassAndFlightsThatCollideAreAllThereAre) {
    for (const Vec3& w : {inward, -inward, normalize(Vec3(1, 0.3f, 0.1f))}) {
        const double expected = guide_.radiance(place_, w);
        Pcg32 random(3);
        constexpr int flights = 100000;
        std::vector<double> drawn;
        for (int i = 0; i < flights; ++i) {
            drawn.push_back(guide_.sample_distance(place_, w, random));
        }
        const Quadrature rule = gauss_legendre(16);
        double collided = 0, from = 0;
        // To where the layers end, and on.
        for (int piece = 1; piece <= 400; ++piece) {
            const double to = 0.02 * piece;
            for (std::size_t k = 0; k < rule.nodes.size(); ++k) {
                const double t = from + rule.nodes[k] * (to - from);
                collided += rule.weights[k] * (to - from) * guide_.flight(place_, w, expected, t, true);
            }
            from = to;
            if (piece % 50 == 0) {
                const double passed = guide_.flight(place_, w, expected, to, false);
                EXPECT_NEAR(collided + passed, 1, 2e-3) << to;
                const auto farther = std::count_if(drawn.begin(), drawn.end(), [&](double t) { return t > to; });
                const double share = static_cast<double>(farther) / flights;
                EXPECT_TRUE(agrees(share, std::sqrt(passed * (1 - passed) / flights), passed, 4.5, 1e-3)) << to;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Media, GuideOfLayers,
                         testing::Values(Problem{"Absorbing", 0, 0, 1, {inward, 0.7f, 100, 1, 1}},
                                         Problem{"HalfSpace", 0.9, 0, 1, {inward, 0.7f, 100, 1, 1}},
                                         Problem{"ThinLitFromBehind", 0.9, 0, 1, {inward, 0.3f, 1, 0.1f, 2}},
                                         Problem{"Forward", 0.9, 0.8, 1.4, {inward, 0.5f, 3, 1, 0.5f}},
                                         Problem{"Backward", 0.9, -0.5, 1.5, {inward, 0.1f, 2, 1, 0}}),
                         [](const auto& problem) { return std::string(problem.param.name); });

}  // namespace
}  // namespace wend
