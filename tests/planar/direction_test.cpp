// Planar directions: what is drawn has the density that is claimed, and that density is one.
#include <tests/sampling/verdicts.h>
#include <tests/support/planar.h>

#include <wend/planar/eigenvalue.h>
#include <wend/planar/modal_decisions.h>
#include <wend/planar/path_stretching.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

using test::adjoint_of;
using test::judge_directions;
using test::PlanarCase;
using test::PlanarVerdict;

constexpr double infinite = std::numeric_limits<double>::infinity();
/// Of about 300 tests in this file, all true ones are passed in 997 runs of 1000.
constexpr double passing = 1e-5;

template <class D>
void expect_honest(const D& decision, double g, const std::vector<double>& depths, const std::string& name) {
    std::uint64_t seed = 0;
    for (const double depth : depths) {
        for (const double before : {-1.0, -0.3, 1e-3, 0.6, 1.0}) {
            const PlanarVerdict v = judge_directions(decision, decision, g, depth, before, ++seed);
            const std::string place = name + ", depth " + std::to_string(depth) + ", before " + std::to_string(before);
            EXPECT_NEAR(v.total, 1, 2e-6) << place;
            EXPECT_GT(v.p_value, passing) << place;
            EXPECT_LT(v.disagreement, 1e-7) << place;
        }
    }
}

TEST(PhaseDirection, ScattersByTheAveragedPhaseFunction) {
    for (const double g : {0.0, 1e-4, 0.5, 0.95, -0.3, -0.8}) {
        expect_honest(PhaseDirection(g), g, {1}, "g " + std::to_string(g));
    }
}

TEST(PhaseDirection, AnotherMeanCosineIsRejected) {
    for (const double g : {0.0, 0.5, -0.3}) {
        EXPECT_LT(judge_directions(PhaseDirection(g + 0.05), PhaseDirection(g), g, 1, 0.6, 1, 100000).p_value,
                  test::failing)
            << g;
    }
}

TEST(DwivediDirection, DrawsTheDiscreteMode) {
    for (const Heading heading : {Heading::near, Heading::far}) {
        for (const double albedo : {0.1, 0.4, 0.8, 0.999}) {
            expect_honest(DwivediDirection(discrete_eigenvalue(albedo).gap, heading), 0, {1},
                          "albedo " + std::to_string(albedo));
        }
    }
}

TEST(DwivediDirection, HeadsForItsBoundary) {
    Pcg32 random(1);
    const double gap = discrete_eigenvalue(0.8).gap;
    for (const auto& [heading, sign] : {std::pair(Heading::near, -1.0), std::pair(Heading::far, 1.0)}) {
        double mean = 0;
        for (int i = 0; i < 10000; ++i) {
            mean += DwivediDirection(gap, heading).sample(1, 0, random).cosine / 10000;
        }
        // ∫ m c nu / (2 (nu - m)) dm = nu - c nu.
        EXPECT_NEAR(mean, sign * 0.2 * discrete_eigenvalue(0.8).nu(), 0.02);
    }
}

TEST(DwivediDirection, StaysFiniteAtEveryAlbedo) {
    Pcg32 random(1);
    for (const double albedo : {0.0, 1e-6, 0.01, 1 - 1e-9, 1.0}) {
        const DwivediDirection decision(discrete_eigenvalue(albedo).gap, Heading::near);
        for (int i = 0; i < 1000; ++i) {
            const PlanarDirection d = decision.sample(1, 0, random);
            EXPECT_TRUE(std::abs(d.cosine) <= 1 && std::isfinite(d.density_ratio) && d.density_ratio > 0) << albedo;
        }
    }
}

TEST(DwivediDirection, AnotherModeIsRejected) {
    const DwivediDirection drawn(discrete_eigenvalue(0.8).gap, Heading::near);
    for (const auto& claimed : {DwivediDirection(discrete_eigenvalue(0.9).gap, Heading::near),
                                DwivediDirection(discrete_eigenvalue(0.8).gap, Heading::far)}) {
        EXPECT_LT(judge_directions(drawn, claimed, 0, 1, 0.5, 1, 100000).p_value, test::failing);
    }
}

struct ModalCase {
    PlanarCase medium;
    std::vector<double> depths;
};

const std::vector<ModalCase>& cases() {
    static const std::vector<ModalCase> all = {
        {{"half-space", 0.8}, {0, 1e-6, 1, 50, 1e5}},
        {{"refractive half-space", 0.9, 0, infinite, 1.5}, {0, 1e-6, 1, 50}},
        {{"slab lit far", 0.5, 0, 10, 1, true}, {0, 1e-6, 1, 9.9, 10}},
        {{"forward half-space", 0.8, 0.8}, {0, 1, 50}},
        {{"forward refractive slab, negative terms", 0.9, 0.8, 2, 1.33}, {0, 1e-6, 1, 2}},
        {{"disturbed slab", 0.8, 0, 5, 1, true, 8, 0.2}, {0, 1, 5}},
        {{"disturbed half-space", 0.8, 0, infinite, 1, false, 8, 0.2}, {0, 1, 50}},
    };
    return all;
}

TEST(ModalDirection, DrawsTheDensityItClaims) {
    for (const ModalCase& c : cases()) {
        expect_honest(ModalDirection(adjoint_of(c.medium), c.medium.g), c.medium.g, c.depths,
                      std::string(c.medium.name));
    }
}

TEST(ModalDirection, DrawsTheDensityOfAGivenRadiance) {
    const double nu = discrete_eigenvalue_henyey_greenstein(0.9, 0.5).nu();
    expect_honest(ModalDirection([=](double mu) { return 1 / (nu + mu); }, 0.5), 0.5, {0, 1, 50}, "asymptotic mode");
}

// The claimed density is that of a table: near the one it should be, in proportion to phase function times radiance.
TEST(ModalDirection, FollowsPhaseFunctionTimesRadiance) {
    for (const ModalCase& c : cases()) {
        const PlanarAdjoint adjoint = adjoint_of(c.medium);
        const ModalDirection decision(adjoint, c.medium.g);
        for (const double depth : c.depths) {
            PlanarAdjoint::Site site;
            adjoint.at(depth, site);
            if (!(adjoint.ray(site, -1).radiance() > 0)) {
                continue;  // too deep for a double to say how little arrives
            }
            for (const double before : {-0.7, 0.5}) {
                const auto wanted = [&](double mu) {
                    return averaged_henyey_greenstein(c.medium.g, before, mu) * adjoint.ray(site, mu).radiance();
                };
                const double total =
                    test::adaptive_integral(wanted, -1, 0, 1e-9) + test::adaptive_integral(wanted, 0, 1, 1e-9);
                const auto error = [&](double mu) {
                    const double claimed =
                        averaged_henyey_greenstein(c.medium.g, before, mu) * decision.density_ratio(depth, before, mu);
                    return std::abs(claimed - wanted(mu) / total);
                };
                const double wrong =
                    test::adaptive_integral(error, -1, 0, 1e-5) + test::adaptive_integral(error, 0, 1, 1e-5);
                EXPECT_LT(wrong, c.medium.g == 0 ? 1e-3 : 1e-2) << c.medium.name << ", depth " << depth;
            }
        }
    }
}

TEST(ModalDirection, AnotherDensityIsRejected) {
    for (const ModalCase& c : cases()) {
        PlanarCase other = c.medium;
        other.albedo = 0.5 * c.medium.albedo;
        const ModalDirection drawn(adjoint_of(c.medium), c.medium.g), claimed(adjoint_of(other), c.medium.g);
        EXPECT_LT(judge_directions(drawn, claimed, c.medium.g, 1, 0.2, 1, 100000).p_value, test::failing)
            << c.medium.name;
    }
}

}  // namespace
}  // namespace wend
