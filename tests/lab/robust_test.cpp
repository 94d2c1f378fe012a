// Extremes: no sampler may hang, lose a walk, or be led astray by a guide that is wrong.
#include <tests/lab/experiments.h>
#include <tests/lab/walks.h>
#include <tests/support/planar.h>

#include <cmath>
#include <vector>

namespace wend {
namespace {

using test::half_space;
using test::run;
using test::slab;

/// By every sampler: all values finite, none negative, the mean at most 1 but for noise.
void expect_sound(PlanarExperiment e, std::uint64_t walks) {
    for (const std::string& sampler : planar_samplers()) {
        e.sampler = sampler;
        const PlanarResult result = run(e, walks);
        const Moments& m = result.channels[0];
        const double exact = result.exact[0];
        const std::string what = sampler + ", albedo " + std::to_string(e.albedo[0]) + ", thickness " +
                                 std::to_string(e.thickness) + ", g " + std::to_string(e.g) + ", ior " +
                                 std::to_string(e.ior) + ", mu0 " + std::to_string(e.mu0.value_or(0));
        EXPECT_EQ(result.rejected, 0u) << what;
        EXPECT_TRUE(std::isfinite(m.mean()) && std::isfinite(m.variance()) && m.mean() >= 0) << what;
        EXPECT_TRUE(exact >= 0 && exact <= 1 + 1e-9) << what << ": exact " << exact;
        EXPECT_LE(m.mean(), 1 + 4 * m.standard_error() + 1e-5) << what;
        // Where the guide is nearly exact, so is every mean, as far as 64 ordinates tell in 60 mean free paths.
        if (sampler == "modes" && e.albedo[0] < 1) {
            EXPECT_TRUE(agrees(m, exact, 4, 1e-3)) << what << ": " << m.mean() << " against " << exact;
        }
    }
}

TEST(PlanarRobustness, EveryAlbedoInHalfSpaces) {
    for (const double albedo : {0.0, 1e-6, 0.9999, 1.0}) {
        for (const std::optional<double>& mu0 : {std::optional(1.0), std::optional(1e-3), std::optional<double>()}) {
            PlanarExperiment e = half_space(albedo, "");
            e.mu0 = mu0;
            expect_sound(e, 50);
        }
        PlanarExperiment e = half_space(albedo, "");
        e.ior = 1.5;
        expect_sound(e, 50);
    }
}

TEST(SlowPlanarRobustness, EveryThickness) {
    for (const double thickness : {1e-4, 1.0, 60.0}) {
        for (const double albedo : {0.0, 1e-6, 0.5, 0.9999, 1.0}) {
            for (const Tally tally : {Tally::reflectance, Tally::transmittance}) {
                for (const std::optional<double>& mu0 : {std::optional(1.0), std::optional(1e-3)}) {
                    PlanarExperiment e = slab(albedo, thickness, tally, "");
                    e.mu0 = mu0;
                    expect_sound(e, 50);
                }
            }
        }
    }
}

TEST(SlowPlanarRobustness, ForwardAndRefractiveExtremes) {
    PlanarExperiment e = slab(0.9999, 1e-4, Tally::transmittance, "");
    e.g = 0.95;
    e.modes = 32;
    expect_sound(e, 50);
    e.thickness = 60;
    e.mu0 = 1e-3;
    e.ior = 1.5;
    e.albedo = {0.5};
    expect_sound(e, 50);
    e = half_space(0.999, "");
    e.g = -0.95;
    e.modes = 32;
    e.ior = 3;
    expect_sound(e, 50);
}

TEST(PlanarRobustness, WithoutAbsorptionAllComesBack) {
    for (const char* sampler : {"classical", "stretched", "dwivedi", "boundary", "modes"}) {
        const PlanarResult result = run(half_space(1, sampler), 1000);
        EXPECT_NEAR(result.channels[0].mean(), 1, 4 * result.channels[0].standard_error() + 1e-9) << sampler;
    }
    for (const char* sampler : {"analog", "classical", "stretched", "dwivedi", "boundary", "modes"}) {
        const PlanarResult back = run(slab(1, 4, Tally::reflectance, sampler), 5000);
        EXPECT_TRUE(test::is_exact(back, 1e-5)) << sampler;
        EXPECT_NEAR(back.exact[0], 0.690926, 2e-5);
    }
}

TEST(PlanarRobustness, WithoutScatteringBeersLawIsLeft) {
    for (const std::string& sampler : planar_samplers()) {
        const PlanarResult through = run(slab(0, 2, Tally::transmittance, sampler), 20000);
        EXPECT_TRUE(test::is_exact(through)) << sampler;
        EXPECT_NEAR(through.exact[0], std::exp(-2), 1e-9);
        EXPECT_EQ(run(half_space(0, sampler), 1000).channels[0].mean(), 0) << sampler;
    }
}

/// Values of walks guided by an adjoint whose coefficients are all off by up to `noise`.
std::vector<double> disturbed_values(const PlanarExperiment& e, double noise, std::uint64_t seed, std::size_t walks) {
    using Sampler = PlanarSampler<ModalFlight, ModalDirection>;
    const PlanarSlab medium = planar_build::make_slab(e, 0);
    PlanarModes modes = solve_planar(planar_build::make_problem(e.albedo[0], e.g, medium, e.modes));
    test::disturb(modes, noise, seed);
    PlanarAdjoint adjoint(modes, medium);
    adjoint.keep_positive();
    const Sampler sampler{planar_build::make_entry(e, medium, &adjoint), ModalFlight(adjoint), ModalFlight(adjoint),
                          ModalDirection(adjoint, e.g), GuidedCrossing(adjoint)};
    const PlanarWalker<ImplicitCapture, Sampler> walker(
        {e.albedo[0], &medium, &sampler, PlanarSurvival(EndlessSurvival{})});
    return test::walk_values(walker, walks, seed);
}

TEST(PlanarRobustness, NoiseInTheGuideCostsVarianceAlone) {
    std::vector<PlanarExperiment> media = {half_space(0.4, "modes"), half_space(0.95, "modes"),
                                           slab(0.5, 5, Tally::transmittance, "modes"),
                                           slab(0.8, 2, Tally::reflectance, "modes")};
    media.push_back(half_space(0.8, "modes"));
    media.back().g = 0.5;
    media.push_back(half_space(0.8, "modes"));
    media.back().ior = 1.5;
    media.back().mu0.reset();
    for (const PlanarExperiment& e : media) {
        const double exact = planar_exact(e)[0];
        for (std::uint64_t seed = 1; seed <= 2; ++seed) {
            Moments m;
            for (const double value : disturbed_values(e, 0.2, seed, 20000)) {
                ASSERT_TRUE(std::isfinite(value));
                m.add(value);
            }
            EXPECT_TRUE(agrees(m, exact, 3, 1e-6)) << e.albedo[0] << ", " << e.thickness << ", g " << e.g << ": "
                                                   << m.mean() << " +- " << m.standard_error() << " against " << exact;
            EXPECT_FALSE(agrees(m, 1.1 * exact, 3, 1e-6)) << m.relative_error();
            // The twin: the noise is there.
            EXPECT_GT(m.variance(), 10 * run(e, 2000).channels[0].variance());
        }
    }
}

}  // namespace
}  // namespace wend
