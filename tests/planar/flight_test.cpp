// Planar flights: what is drawn has the density that is claimed, and that density is one.
#include <tests/sampling/verdicts.h>
#include <tests/support/planar.h>

#include <wend/planar/modal_decisions.h>
#include <wend/planar/path_stretching.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

using test::adjoint_of;
using test::judge_flights;
using test::PlanarCase;
using test::PlanarVerdict;

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Of about 400 tests in this file, all true ones are passed in 996 runs of 1000.
constexpr double passing = 1e-5;

const std::vector<PlanarCase>& cases() {
    static const std::vector<PlanarCase> all = {
        {"half-space", 0.8},
        {"few modes", 0.95, 0, infinite, 1, false, 2},
        {"forward half-space", 0.8, 0.8},
        {"refractive half-space", 0.9, 0, infinite, 1.5},
        {"slab lit near", 0.95, 0, 2},
        {"slab lit far", 0.5, 0, 10, 1, true},
        {"forward refractive slab, negative terms", 0.9, 0.8, 2, 1.33},
        {"backward slab lit far", 0.8, -0.3, 5, 1, true},
        {"disturbed half-space", 0.8, 0, infinite, 1, false, 8, 0.2},
        {"disturbed forward half-space", 0.8, 0.8, infinite, 1, false, 8, 0.2},
        {"disturbed slab", 0.8, 0, 5, 1, true, 8, 0.2},
    };
    return all;
}

std::vector<double> depths_of(double thickness) {
    std::vector<double> depths = {0, 1e-6, 1};
    depths.push_back(std::isinf(thickness) ? 50 : thickness);
    return depths;
}

template <class D>
void expect_honest(const D& decision, double thickness, const std::string& name) {
    std::uint64_t seed = 0;
    for (const double depth : depths_of(thickness)) {
        for (const double mu : {-1.0, -0.4, -1e-3, 1e-3, 0.5, 1.0}) {
            const PlanarVerdict v = judge_flights(decision, decision, thickness, depth, mu, ++seed);
            const std::string place = name + ", depth " + std::to_string(depth) + ", cosine " + std::to_string(mu);
            EXPECT_NEAR(v.total, 1, 1e-7) << place;
            EXPECT_GT(v.p_value, passing) << place;
            EXPECT_LT(v.disagreement, 1e-9) << place;
        }
    }
}

TEST(PathStretching, FliesByTheDensityItClaims) {
    for (const double stretch : {0.0, 0.4, 0.999}) {
        const std::string name = "stretch " + std::to_string(stretch);
        expect_honest(PathStretching(infinite, Heading::near, stretch), infinite, name);
        expect_honest(PathStretching(3, Heading::near, stretch), 3, name + ", slab");
        expect_honest(PathStretching(3, Heading::far, stretch), 3, name + ", slab, far");
    }
}

TEST(PathStretching, AnotherDensityIsRejected) {
    for (const Heading heading : {Heading::near, Heading::far}) {
        const PathStretching drawn(3, heading, 0.5), claimed(3, heading, 0.4);
        for (const double mu : {-1.0, -0.7, 0.7, 1.0}) {
            EXPECT_LT(judge_flights(drawn, claimed, 3, 1.5, mu, 1, 100000).p_value, test::failing) << mu;
        }
    }
}

TEST(PathStretching, WithoutStretchIsClassical) {
    const PathStretching classical(infinite, Heading::near, 0);
    Pcg32 random(1);
    PathStretching::Site from, to;
    classical.at(2, from);
    for (int i = 0; i < 1000; ++i) {
        EXPECT_EQ(classical.sample(from, i % 2 == 0 ? -0.5 : 0.5, random, to).density_ratio, 1);
    }
}

TEST(ModalFlight, FliesByTheDensityItClaims) {
    for (const PlanarCase& c : cases()) {
        const PlanarAdjoint adjoint = adjoint_of(c);
        expect_honest(ModalFlight(adjoint), c.thickness, std::string(c.name));
    }
}

TEST(ModalFlight, CasesHaveTermsOfBothSigns) {
    int mixed = 0;
    for (const PlanarCase& c : cases()) {
        mixed += adjoint_of(c).all_positive() ? 0 : 1;
    }
    EXPECT_GE(mixed, 4);
}

TEST(ModalFlight, AnotherDensityIsRejected) {
    for (const PlanarCase& c : cases()) {
        PlanarCase other = c;
        other.albedo = 0.6 * c.albedo;
        const PlanarAdjoint adjoint = adjoint_of(c), wrong = adjoint_of(other);
        EXPECT_LT(judge_flights(ModalFlight(adjoint), ModalFlight(wrong), c.thickness, 1, c.lit_at_far ? 0.4 : -0.4, 1,
                                100000)
                      .p_value,
                  test::failing)
            << c.name;
    }
}

// A flight's density with the adjoint of Case's modes is transmittance times source over radiance: so it may not depend
// on the boundary that a half-space does not have.
TEST(ModalFlight, NeverReachesTheFarSideOfAHalfSpace) {
    const PlanarAdjoint adjoint = adjoint_of({"half-space", 0.95});
    const ModalFlight flight(adjoint);
    ModalFlight::Site from, to;
    Pcg32 random(3);
    for (const double depth : {0.0, 50.0, 1e4, 1e6}) {
        flight.at(depth, from);
        for (int i = 0; i < 1000; ++i) {
            const PlanarFlight f = flight.sample(from, 0.7, random, to);
            EXPECT_TRUE(f.scatters && std::isfinite(f.length) && f.density_ratio > 0) << depth;
        }
    }
}

}  // namespace
}  // namespace wend
