#include <tests/planar/problems.h>
#include <tests/sampling/verdicts.h>
#include <tests/support/slab_references.h>
#include <wend/core/random.h>
#include <wend/medium/averaged_phase.h>
#include <wend/planar/case_modes.h>
#include <wend/planar/eigenvalue.h>
#include <wend/planar/half_space.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace wend {
namespace {

using namespace test;

TEST(DiscreteOrdinates, HaveTheExactReflectanceOfTheIsotropicHalfSpace) {
    for (const double albedo : {0.0, 1e-6, 0.1, 0.2, 0.4, 0.8, 0.95, 0.99, 0.9999, 1 - 1e-9, 1.0}) {
        const PlanarAdjoint adjoint = solved(planar_problem(albedo, 0, infinity, 32));
        for (const double mu0 : {1e-3, 0.01, 0.1, 0.5, 1.0}) {
            EXPECT_NEAR(seen(adjoint, mu0), reflectance(albedo, mu0), 2e-10) << "albedo " << albedo << ", mu0 " << mu0;
        }
        EXPECT_NEAR(diffuse_mean([&](double mu0) { return seen(adjoint, mu0); }), diffuse_reflectance(albedo), 1e-12);
    }
}

TEST(DiscreteOrdinates, HaveTheExactSourceOfTheIsotropicHalfSpace) {
    for (const double albedo : {0.2, 0.8, 0.99}) {
        const PlanarAdjoint adjoint = solved(planar_problem(albedo, 0, infinity, 48));
        const CaseModes exact = case_modes(albedo, 400);
        for (const double depth : {0.0, 0.01, 0.3, 2.0, 20.0}) {
            double expected = 0;
            for (std::size_t i = 0; i < exact.nu.size(); ++i) {
                expected += albedo * exact.coefficient[i] * std::exp(-depth / exact.nu[i]);
            }
            PlanarAdjoint::Site site;
            adjoint.at(depth, site);
            EXPECT_NEAR(adjoint.source(site, 0.3).value / expected, 1, 2e-7) << albedo << ", depth " << depth;
        }
    }
}

/// The radiance that arrives at a depth, scattered into the direction mu: the source again, if and only if the modes
/// solve the transport equation. The phase function is the true one, whatever moments of it the solver has used.
double scattered(const PlanarAdjoint& adjoint, double albedo, double g, double depth, double mu) {
    static const Quadrature rule = gauss_legendre(120);
    // Panels dense at their ends: radiance is singular at 0 and the critical angle, the phase function peaked at ±mu.
    const double ior = adjoint.slab().near.ior;
    const double critical = std::sqrt(1 - 1 / (ior * ior));
    std::vector<double> ends = {-1, -std::abs(mu), -critical, 0, critical, std::abs(mu), 1};
    std::sort(ends.begin(), ends.end());
    double sum = 0;
    for (std::size_t panel = 0; panel + 1 < ends.size(); ++panel) {
        const double width = ends[panel + 1] - ends[panel];
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double u = rule.nodes[i];
            const double from = ends[panel] + width * u * u * (3 - 2 * u);
            sum += rule.weights[i] * width * 6 * u * (1 - u) * averaged_henyey_greenstein(g, mu, from) *
                   adjoint.radiance(depth, from);
        }
    }
    return albedo * sum;
}

/// The largest relative error of the source against one collision.
double collision_error(const PlanarAdjoint& adjoint, double albedo, double g, double scale = 1) {
    double worst = 0;
    const double thickness = adjoint.slab().thickness;
    for (const double depth : {0.0, 1e-3, 0.03, 0.3, 2.0, 9.0}) {
        if (depth > thickness) {
            continue;
        }
        PlanarAdjoint::Site site;
        adjoint.at(depth, site);
        for (const double mu : {-0.999, -0.4, 0.05, 0.7, 1.0}) {
            const double source = scale * adjoint.source(site, mu).value;
            worst = std::max(worst, std::abs(scattered(adjoint, albedo, g, depth, mu) / source - 1));
        }
    }
    return worst;
}

TEST(DiscreteOrdinates, SolveTheTransportEquation) {
    struct Row {
        double g, thickness, ior, tolerance;
    };
    // What is left with anisotropic scattering is the interpolation of the source between directions.
    for (const Row& row : {Row{0, infinity, 1, 1e-7}, Row{0, 3, 1, 1e-7}, Row{0, infinity, 1.5, 2e-9},
                           Row{0, 3, 1.33, 2e-9}, Row{0.5, infinity, 1, 2e-6}, Row{0.5, 3, 1, 2e-6},
                           Row{-0.5, 10, 1, 2e-6}, Row{0.5, 1, 1.5, 4e-6}, Row{0.8, infinity, 1, 1e-5}}) {
        for (const double albedo : {0.5, 0.95}) {
            const PlanarAdjoint adjoint = solved(planar_problem(albedo, row.g, row.thickness, 40, from_near, row.ior));
            EXPECT_LT(collision_error(adjoint, albedo, row.g), row.tolerance)
                << "albedo " << albedo << ", g " << row.g << ", thickness " << row.thickness << ", index " << row.ior;
        }
    }
}

TEST(DiscreteOrdinates, OfAnotherAlbedoDoNotSolveIt) {
    EXPECT_GT(collision_error(solved(planar_problem(0.81, 0.5, infinity, 40)), 0.8, 0.5), 1e-3);
}

TEST(DiscreteOrdinates, ConvergeWithTheFourthPowerOfTheirNumber) {
    const auto error = [](int nodes) {
        return collision_error(solved(planar_problem(0.8, 0, infinity, nodes - 1)), 0.8, 0);
    };
    EXPECT_LT(error(4), 2e-3);
    EXPECT_LT(error(8), error(4) / 14);
    EXPECT_LT(error(32), error(8) / (14 * 14));
}

// Adding and doubling with 48 streams; two of them checked by walks. Each is right to half a unit of its last digit.
TEST(DiscreteOrdinates, AgreeWithAddingAndDoublingForAnisotropicHalfSpaces) {
    struct Row {
        double g, albedo, reflectance;
    };
    for (const Row& row :
         {Row{0.5, 0.8, .161535}, Row{0.5, 0.95, .403878}, Row{0.5, 0.99, .664607}, Row{0.75, 0.8, .081474},
          Row{0.75, 0.95, .276766}, Row{0.75, 0.99, .559170}, Row{0.8, 0.8, .063908}, Row{0.8, 0.95, .238946},
          Row{0.8, 0.99, .521913}, Row{0.875, 0.8, .037460}, Row{0.875, 0.95, .167652}, Row{0.875, 0.99, .439652},
          Row{0.9, 0.8, .028910}, Row{0.9, 0.95, .138643}, Row{0.9, 0.99, .399541}, Row{-0.3, 0.8, .344607},
          Row{-0.3, 0.95, .584095}, Row{-0.3, 0.99, .780716}}) {
        EXPECT_NEAR(seen(solved(planar_problem(row.albedo, row.g, infinity, 63)), 1), row.reflectance, 6e-7)
            << "g " << row.g << ", albedo " << row.albedo;
    }
}

TEST(DiscreteOrdinates, AgreeWithAddingAndDoublingForSlabs) {
    struct Row {
        double g, albedo, thickness, reflectance, transmittance;
    };
    for (const Row& row :
         {Row{0, .8, 1, .210847, .541400},    Row{0, .95, 1, .301718, .622567},   Row{0, 1, 1, .341329, .658671},
          Row{0, .8, 2, .265939, .285950},    Row{0, .95, 2, .428724, .409308},   Row{0, 1, 2, .517515, .482485},
          Row{0, .8, 4, .284025, .075085},    Row{0, .95, 4, .512422, .186915},   Row{0, 1, 4, .690926, .309074},
          Row{0, .8, 8, .285250, .004647},    Row{0, .95, 8, .534432, .040761},   Row{0, 1, 8, .821803, .178197},
          Row{.75, .8, 2, .061777, .534941},  Row{.75, .95, 2, .124869, .740764}, Row{.75, 1, 2, .163176, .836824},
          Row{.75, .8, 4, .077357, .253561},  Row{.75, .95, 4, .203461, .513325}, Row{.75, 1, 4, .311639, .688361},
          Row{.75, .8, 8, .081321, .049961},  Row{.75, .95, 8, .261380, .234301}, Row{.75, 1, 8, .506415, .493585},
          Row{.875, .99, 8, .258425, .608078}}) {
        const double reflected = seen(solved(planar_problem(row.albedo, row.g, row.thickness, 47)), 1);
        const double transmitted = seen(solved(planar_problem(row.albedo, row.g, row.thickness, 47, from_far)), 1);
        EXPECT_NEAR(reflected, row.reflectance, 6e-7) << row.g << " " << row.albedo << " " << row.thickness;
        EXPECT_NEAR(transmitted, row.transmittance, 6e-7) << row.g << " " << row.albedo << " " << row.thickness;
    }
}

TEST(DiscreteOrdinates, AgreeWithVanDeHulstsTables) {
    struct Row {
        double g, albedo, thickness, mu0, reflectance, transmittance;
    };
    for (const Row& row : {Row{0.75, 0.9, 2, 1, .09739, .66096}, Row{0, 0.99, 1, 0.5, .48652, .49163},
                           Row{0.5, 0.99, 4, 0.5, .61996, .30605}}) {
        EXPECT_NEAR(seen(solved(planar_problem(row.albedo, row.g, row.thickness, 47)), row.mu0), row.reflectance, 6e-6);
        EXPECT_NEAR(seen(solved(planar_problem(row.albedo, row.g, row.thickness, 47, from_far)), row.mu0),
                    row.transmittance, 6e-6);
    }
}

TEST(DiscreteOrdinates, AgreeWithTheSlabReferences) {
    const std::vector<SlabReference> references = slab_references();
    EXPECT_GT(references.size(), 30u);
    for (const SlabReference& row : references) {
        const auto see = [&](Lit lit) {
            const PlanarAdjoint adjoint = solved(planar_problem(row.albedo, 0, row.thickness, 48, lit));
            return row.mu0 ? seen(adjoint, *row.mu0) : diffuse_mean([&](double mu0) { return seen(adjoint, mu0); });
        };
        EXPECT_NEAR(see(from_far), row.transmittance, 1e-9 * row.transmittance) << row.text;
        EXPECT_NEAR(see(from_near), row.reflectance, 1e-9 * row.reflectance) << row.text;
    }
}

TEST(DiscreteOrdinates, HaveTheDiscreteEigenvalue) {
    for (const double g : {0.0, 0.5, -0.5, 0.9}) {
        for (const double albedo : {0.8, 0.99, 1 - 1e-6, 1 - 1e-9}) {
            const PlanarModes modes = solve_planar(planar_problem(albedo, g, infinity, 32));
            const double expected = discrete_eigenvalue_henyey_greenstein(albedo, g).nu();
            EXPECT_NEAR(modes.modes[0].length / expected, 1, 1e-12) << "g " << g << ", albedo " << albedo;
        }
    }
    EXPECT_TRUE(std::isinf(solve_planar(planar_problem(1, 0.5, infinity, 8)).modes[0].length));
}

TEST(DiscreteOrdinates, SolveTheFresnelHalfSpace) {
    // By an independent solver with split nodes, and by walks (the last one, 0.000118).
    EXPECT_NEAR(seen(solved(planar_problem(0.9, 0, infinity, 48, from_near, 1.5)), 1), .2599186, 1e-7);
    EXPECT_NEAR(seen(solved(planar_problem(0.8, 0, infinity, 48, from_near, 1.4)), 1), .1808231, 1e-7);
    EXPECT_NEAR(seen_inside(solved(planar_problem(0.95, 0, infinity, 48, from_near, 1.4)), 1), .3591250, 1e-7);
    EXPECT_NEAR(seen_inside(solved(planar_problem(0.99, 0, infinity, 48, from_near, 1.4)), 1), .6035893, 1e-7);
    const PlanarAdjoint adjoint = solved(planar_problem(0.8, 0, infinity, 48, from_near, 1.4));
    EXPECT_NEAR(diffuse_mean([&](double mu0) { return seen(adjoint, mu0); }), .230611, 3 * .000118);
}

TEST(DiscreteOrdinates, LoseNothingWithoutAbsorption) {
    // Lit from both sides, all is white; lit from one, what is not reflected is transmitted.
    for (const double g : {0.0, 0.5, -0.5, 0.9}) {
        for (const double thickness : {1e-4, 0.1, 1.0, 30.0, 600.0}) {
            for (const double ior : {1.0, g < 0.9 ? 1.33 : 1.0}) {
                const PlanarAdjoint both = solved(planar_problem(1, g, thickness, 24, from_both, ior));
                const PlanarAdjoint near = solved(planar_problem(1, g, thickness, 24, from_near, ior));
                const PlanarAdjoint far = solved(planar_problem(1, g, thickness, 24, from_far, ior));
                for (const double mu0 : {0.02, 0.5, 1.0}) {
                    EXPECT_NEAR(seen(both, mu0), 1, 1e-6) << g << " " << thickness << " " << ior << " " << mu0;
                    EXPECT_NEAR(seen(near, mu0) + seen_inside(far, mu0), 1, 1e-6)
                        << g << " " << thickness << " " << ior << " " << mu0;
                }
                EXPECT_NEAR(both.radiance(0.4 * thickness, 0.3), 1, 1e-6);
                EXPECT_NEAR(both.radiance(0.9 * thickness, -0.7), 1, 1e-6);
            }
        }
    }
}

TEST(DiscreteOrdinates, AreReciprocal) {
    // What light distributed as f brings to a detector as h is what light as h brings to a detector as f, on one side
    // and through the slab.
    using Distribution = std::function<double(double)>;
    const Distribution f = [](double mu) { return mu * mu; };
    const Distribution h = [](double mu) { return 1 - 0.6 * mu; };
    const Distribution dark;
    PlanarProblem problem = planar_problem(0.9, 0.6, 2, 40, from_near, 1.4);
    const auto detected = [&](const Distribution& near_light, const Distribution& far_light,
                              const Distribution& detector) {
        problem.slab.near.illumination = near_light;
        problem.slab.far.illumination = far_light;
        const PlanarAdjoint adjoint = solved(problem);
        return diffuse_mean([&](double mu0) { return detector(mu0) * seen_inside(adjoint, mu0); });
    };
    EXPECT_NEAR(detected(f, dark, h) / detected(h, dark, f), 1, 1e-6);
    EXPECT_NEAR(detected(dark, f, h) / detected(dark, h, f), 1, 1e-6);
    EXPECT_GT(std::abs(detected(f, dark, h) / detected(f, dark, f) - 1), 1e-2);
}

TEST(DiscreteOrdinates, LitFromTheFarSideAreMirrored) {
    const PlanarAdjoint near = solved(planar_problem(0.9, 0.5, 3, 16, from_near, 1.3));
    const PlanarAdjoint far = solved(planar_problem(0.9, 0.5, 3, 16, from_far, 1.3));
    for (const double depth : {0.0, 0.2, 1.5, 2.9, 3.0}) {
        for (const double mu : {-1.0, -0.2, 0.3, 0.9}) {
            EXPECT_NEAR(near.radiance(depth, mu), far.radiance(3 - depth, -mu), 1e-11);
        }
    }
}

/// What an analog walk of a camera entering a slab at normal incidence brings, under a white sky; the phase function is
/// Rayleigh's, (3/16π)(1 + cos²).
double rayleigh_walk(double albedo, double thickness, Pcg32& random) {
    double depth = 0, mu = 1;
    for (;;) {
        depth -= mu * std::log1p(-random.uniform_double());
        if (depth < 0) {
            return 1;
        }
        if (depth > thickness || random.uniform_double() >= albedo) {
            return 0;
        }
        double cosine;
        do {
            cosine = 2 * random.uniform_double() - 1;
        } while (2 * random.uniform_double() > 1 + cosine * cosine);
        const double azimuth = 2 * std::acos(-1.0) * random.uniform_double();
        mu = mu * cosine + std::sqrt((1 - mu * mu) * (1 - cosine * cosine)) * std::cos(azimuth);
        mu = std::clamp(mu, -1.0, 1.0);
    }
}

TEST(DiscreteOrdinates, TakeAnyLegendreMoments) {
    PlanarProblem problem = planar_problem(0.95, 0, 4, 24);
    const double isotropic = seen(solved(problem), 1);
    problem.moments = {1, 0, 0.1};
    const double rayleigh = seen(solved(problem), 1);
    Pcg32 random(1);
    Moments walks;
    for (int i = 0; i < 400000; ++i) {
        walks.add(rayleigh_walk(0.95, 4, random));
    }
    EXPECT_TRUE(is_within_one_percent(walks, rayleigh));
    EXPECT_FALSE(is_within_one_percent(walks, isotropic)) << isotropic << " and " << rayleigh;
}

TEST(DiscreteOrdinates, BecomeSmoothAsRoughnessVanishes) {
    const double smooth = seen_inside(solved(planar_problem(0.9, 0, infinity, 24, from_near, 1.4)), 1);
    double before = 1;
    for (const double alpha : {0.3, 0.1, 0.05}) {
        PlanarProblem problem = planar_problem(0.9, 0, infinity, 24, from_near, 1.4);
        const RoughBoundary rough(1.4, alpha);
        problem.slab.near.rough = problem.slab.far.rough = std::make_shared<RoughBoundary>(rough);
        const PlanarAdjoint adjoint = solved(problem);
        const double error =
            std::abs(rough.transmitted_from_outside(1, [&](double t) { return adjoint.radiance(0, t); }) - smooth);
        EXPECT_LT(error, before);
        before = error;
    }
    EXPECT_LT(before, 0.01 * smooth);
}

TEST(DiscreteOrdinates, StayFiniteAndBetweenNothingAndEverything) {
    for (const double albedo : {0.0, 1e-6, 0.5, 0.9999, 1.0}) {
        for (const double thickness : {1e-4, 1.0, 60.0, 600.0, double{infinity}}) {
            for (const double g : {0.0, 0.9, -0.9}) {
                const PlanarAdjoint adjoint = solved(planar_problem(albedo, g, thickness, 16));
                for (const double mu0 : {1e-12, 1e-3, 1.0}) {
                    EXPECT_GE(seen(adjoint, mu0), -1e-5) << albedo << " " << thickness << " " << g << " " << mu0;
                    EXPECT_LE(seen(adjoint, mu0), 1 + 1e-5) << albedo << " " << thickness << " " << g << " " << mu0;
                }
            }
        }
    }
}

TEST(DiscreteOrdinates, OfFewNodesStandPeakedScattering) {
    for (const double g : {-0.949, 0.9, 0.949}) {
        for (int transients = 0; transients <= 12; ++transients) {
            for (const double ior : {1.0, 1.5}) {
                const PlanarModes modes = solve_planar(planar_problem(0.99, g, infinity, transients, from_near, ior));
                const double nu = discrete_eigenvalue_henyey_greenstein(0.99, g).nu();
                EXPECT_LT(modes.modes[0].length, 1.001 * nu) << g << " " << transients << " " << ior;
                const PlanarProblem furnace = planar_problem(1, g, 2, transients, from_both);
                EXPECT_NEAR(solved(furnace).radiance(1, -1), 1, 0.05) << g << " " << transients;
            }
        }
    }
}

TEST(DiscreteOrdinates, RefuseWhatIsOutOfRange) {
    const auto refuses = [](const auto& change) {
        PlanarProblem problem = planar_problem(0.8, 0.3, 2, 8);
        change(problem);
        EXPECT_THROW(solve_planar(problem), std::invalid_argument);
    };
    constexpr double nan = std::numeric_limits<double>::quiet_NaN();
    refuses([](PlanarProblem& p) { p.albedo = -1e-9; });
    refuses([](PlanarProblem& p) { p.albedo = 1.01; });
    refuses([](PlanarProblem& p) { p.albedo = nan; });
    refuses([](PlanarProblem& p) { p.moments = {}; });
    refuses([](PlanarProblem& p) { p.moments = {0.9}; });
    refuses([](PlanarProblem& p) { p.moments = {1, 0.2, nan}; });
    refuses([](PlanarProblem& p) { p.moments = {1, 1}; });
    refuses([](PlanarProblem& p) { p.slab.thickness = 0; });
    refuses([](PlanarProblem& p) { p.slab.thickness = nan; });
    refuses([](PlanarProblem& p) { p.slab.near.ior = 0.9; });
    refuses([](PlanarProblem& p) { p.slab.far.ior = nan; });
    refuses([](PlanarProblem& p) { p.transients = -1; });
    refuses([](PlanarProblem& p) { p.transients = PlanarAdjoint::max_modes; });
}

}  // namespace
}  // namespace wend
