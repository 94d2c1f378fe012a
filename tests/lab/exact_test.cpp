// With the exact kernels nothing is left to chance: every single walk brings the exact value.
#include <tests/lab/walks.h>
#include <tests/support/planar.h>
#include <wend/planar/case_modes.h>
#include <wend/planar/half_space.h>

#include <gtest/gtest.h>

#include <algorithm>

namespace wend {
namespace {

/// Cosines in proportion to the adjoint's radiance itself: by rejection, normalized by numerical quadrature.
class ExactDirection {
public:
    explicit ExactDirection(const PlanarAdjoint& adjoint) : adjoint_(&adjoint) {}

    PlanarDirection sample(double depth, double before, Pcg32& random) const {
        PlanarAdjoint::Site site;
        adjoint_->at(depth, site);
        const auto radiance = [&](double mu) { return adjoint_->ray(site, mu).radiance(); };
        // Radiance that a white sky of 1 sends into a medium of albedo below 1 is below 1.
        for (;;) {
            const double mu = 2 * random.uniform_double() - 1;
            if (random.uniform_double() < radiance(mu)) {
                return {mu, density_ratio(depth, before, mu)};
            }
        }
    }
    double density_ratio(double depth, double /*before*/, double after) const {
        PlanarAdjoint::Site site;
        adjoint_->at(depth, site);
        const auto radiance = [&](double mu) { return adjoint_->ray(site, mu).radiance(); };
        const double mean =
            0.5 * (test::adaptive_integral(radiance, -1, 0, 1e-11) + test::adaptive_integral(radiance, 0, 1, 1e-11));
        return radiance(after) / mean;
    }

private:
    const PlanarAdjoint* adjoint_;
};
static_assert(PlanarDirectionDecision<ExactDirection>);

/// Largest distance of any walk's value from the exact one, by the adjoint of so many of Case's transients.
double worst_walk(double albedo, int transients) {
    PlanarSlab slab;
    slab.near.illumination = [](double /*cosine*/) { return 1.0; };
    const CaseModes exact = case_modes(albedo, transients);
    PlanarModes modes;
    for (std::size_t k = 0; k < exact.nu.size(); ++k) {
        modes.modes.push_back({exact.nu[k], albedo * exact.coefficient[k], 0, {1}});
    }
    const PlanarAdjoint adjoint(modes, slab);
    const PlanarSampler<ModalFlight, ExactDirection> sampler{PlanarEntry(slab, 1.0), ModalFlight(adjoint),
                                                             ModalFlight(adjoint), ExactDirection(adjoint),
                                                             ClassicalCrossing(slab)};
    const PlanarWalker<ImplicitCapture, PlanarSampler<ModalFlight, ExactDirection>> walker(
        {albedo, &slab, &sampler, PlanarSurvival(EndlessSurvival{})});
    double worst = 0;
    for (const double value : test::walk_values(walker, 200, 1)) {
        worst = std::max(worst, std::abs(value - reflectance(albedo, 1)));
    }
    return worst;
}

TEST(ExactKernels, EverySingleWalkBringsTheExactValue) {
    for (const double albedo : {0.4, 0.8, 0.95}) {
        EXPECT_LT(worst_walk(albedo, 64), 1e-6) << albedo;
    }
}

TEST(ExactKernels, FewerNodesAreNotExact) {
    for (const double albedo : {0.4, 0.8, 0.95}) {
        EXPECT_GT(worst_walk(albedo, 8), 1e-5) << albedo;
    }
}

}  // namespace
}  // namespace wend
