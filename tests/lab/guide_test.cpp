// Guides made for another albedo: where their variance is finite, and where it is not.
#include <tests/lab/experiments.h>
#include <wend/planar/discrete_ordinates.h>
#include <wend/planar/half_space.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace wend {
namespace {

using test::half_space;
using test::run;

// Effective albedo c² nu atanh(1/nu) = c²/a, for the nu of a guide's albedo a.
TEST(GuideForAnotherAlbedo, IsFiniteFromTheSquareOfTheAlbedoOn) {
    for (const double c : {0.2, 0.5, 0.8, 0.95, 0.99}) {
        for (const double a : {0.1, 0.3, 0.5, 0.64, 0.8, 0.9025, 0.95, 0.999}) {
            const double effective = effective_albedo(c, discrete_eigenvalue(a));
            EXPECT_NEAR(effective, c * c / a, 1e-9 * c * c / a);
            EXPECT_EQ(effective <= 1 + 1e-9, a >= c * c * (1 - 1e-9)) << c << " guided by " << a;
        }
    }
}

/// Median over repetitions of the sample variance of so many walks: with a finite variance it does not depend on their
/// number; without, the largest value seen rules it, and it grows.
double typical_variance(PlanarExperiment e, std::uint64_t walks) {
    std::vector<double> variances;
    for (std::uint64_t seed = 0; seed < 9; ++seed) {
        variances.push_back(run(e, walks, seed).channels[0].variance());
    }
    std::nth_element(variances.begin(), variances.begin() + 4, variances.end());
    return variances[4];
}

double growth(double albedo, double guide) {
    PlanarExperiment e = half_space(albedo, "dwivedi");
    e.guide_albedo = guide;
    return typical_variance(e, 64000) / typical_variance(e, 1000);
}

TEST(GuideForAnotherAlbedo, VarianceGrowsBelowTheBound) {
    EXPECT_GT(growth(0.95, 0.6), 1.5);
    EXPECT_GT(growth(0.95, 0.75), 1.5);
    EXPECT_GT(growth(0.8, 0.5), 1.5);
}

TEST(GuideForAnotherAlbedo, VarianceDoesNotGrowAboveTheBound) {
    for (const auto& [albedo, guide] :
         {std::pair(0.95, 0.95), std::pair(0.95, 0.97), std::pair(0.8, 0.8), std::pair(0.8, 0.95)}) {
        EXPECT_NEAR(growth(albedo, guide), 1, 0.15) << albedo << " guided by " << guide;
    }
}

TEST(GuideForAnotherAlbedo, SecondMomentIsItsClosedForm) {
    for (const auto& [albedo, guide] : {std::pair(0.8, 0.9), std::pair(0.8, 0.95), std::pair(0.4, 0.6)}) {
        PlanarExperiment e = half_space(albedo, "dwivedi");
        e.guide_albedo = guide;
        const PlanarResult result = run(e, 100000);
        EXPECT_TRUE(test::is_exact(result));
        const double exact = reflectance(albedo, 1);
        const double variance =
            stretched_second_moment(albedo, discrete_eigenvalue(guide), 1, FirstFlight::stretched) - exact * exact;
        EXPECT_NEAR(result.channels[0].variance(), variance, 0.03 * variance) << albedo << " guided by " << guide;
    }
}

// Of three channels, none is guided by a darker one's mode alone: the bright one's variance stays.
TEST(GuideForAnotherAlbedo, BrightChannelsAreNotLeftToDarkGuides) {
    PlanarExperiment e = half_space(0.95, "dwivedi");
    e.albedo = {0.95, 0.5, 0.1};
    EXPECT_NEAR(typical_variance(e, 64000) / typical_variance(e, 1000), 1, 0.15);
    EXPECT_LT(typical_variance(e, 4000), 3 * dwivedi_variance(0.95, 1, FirstFlight::stretched) + 0.3);
}

PlanarModes one_mode(double length, double near, double far, std::vector<double> shape) {
    return {{{length, near, far, std::move(shape)}}};
}

// The medium's own modes, given as a table, are what the sampler follows anyway.
TEST(AdjointOfOnesOwn, TheSolutionIsTheSampler) {
    const PlanarExperiment e = half_space(0.9, "modes");
    PlanarExperiment own = e;
    PlanarProblem problem;
    problem.albedo = 0.9;
    problem.slab.near.illumination = [](double /*cosine*/) { return 1.0; };
    problem.transients = e.modes;
    own.adjoint = solve_planar(problem);
    const PlanarResult a = run(e, 10000), b = run(own, 10000);
    EXPECT_NEAR(b.channels[0].mean(), a.channels[0].mean(), 1e-9);
    EXPECT_LT(b.channels[0].variance(), 1e-6);
}

// A guess keeps the mean, in any medium: it costs variance alone.
TEST(SlowAdjointOfOnesOwn, AnyGuessKeepsTheMean) {
    for (const double g : {-0.5, 0.0, 0.6}) {
        PlanarExperiment e = half_space(0.9, "modes");
        e.g = g;
        e.adjoint = one_mode(1.1 / discrete_eigenvalue_henyey_greenstein(0.9, g).k, 1, 0, {1, 0.1});
        const PlanarResult result = run(e, 150000);
        EXPECT_TRUE(test::is_exact(result)) << g;
        EXPECT_LT(4 * result.channels[0].standard_error(), 0.01 * result.exact[0]) << g;
    }
    PlanarExperiment slab = half_space(0.8, "modes");
    slab.thickness = 4;
    slab.tally = Tally::transmittance;
    slab.ior = 1.4;
    // Terms that together are negative here and there are lowered.
    slab.adjoint = one_mode(1.6, 0.01, 1, {1});
    slab.adjoint->modes.push_back({0.5, 0, -0.8, {1, 0.3, 0.2}});
    const PlanarResult result = run(slab, 300000);
    EXPECT_TRUE(test::is_exact(result));
    EXPECT_LT(4 * result.channels[0].standard_error(), 0.01 * result.exact[0]);
}

}  // namespace
}  // namespace wend
