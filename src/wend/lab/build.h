// How the experiments of the one-dimensional laboratory are put together: its own header, shared by its sources alone.
#pragma once

#include <wend/lab/lab.h>
#include <wend/lab/walk.h>
#include <wend/planar/discrete_ordinates.h>
#include <wend/planar/eigenvalue.h>
#include <wend/planar/modal_decisions.h>

#include <algorithm>
#include <array>
#include <functional>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

namespace wend::planar_build {

/// Modes of the solutions that serve as references.
constexpr int reference_transients = 63;

/// Throws InputError for values outside their ranges.
void validate(const PlanarExperiment& experiment);

bool is_half_space(const PlanarExperiment& experiment);
double extinction_of(const PlanarExperiment& experiment, std::size_t channel);
Heading heading_of(const PlanarExperiment& experiment);
PlanarSlab make_slab(const PlanarExperiment& experiment, std::size_t channel);
PlanarProblem make_problem(double albedo, double g, const PlanarSlab& slab, int transients);
PlanarEntry make_entry(const PlanarExperiment& experiment, const PlanarSlab& slab, const PlanarAdjoint* adjoint);

/// The albedo a guide is made for.
double guide_albedo(const PlanarExperiment& experiment, std::size_t channel, double thickness);

/// The radiance of the longest mode alone, by cosine, up to a factor.
std::function<double(double)> asymptotic_radiance(double albedo, double g, double k, Heading heading);

/// The adjoint that `boundary` and `modes` follow.
std::unique_ptr<PlanarAdjoint> make_guide(const PlanarExperiment& experiment, double albedo, const PlanarSlab& slab);

/// What a sampler is made of, kept for as long as it is used.
struct Guide {
    PlanarSlab slab;
    std::unique_ptr<PlanarAdjoint> adjoint;
};

/// How often each of three channels is followed: in proportion to what it is expected to bring. A bright
/// channel's guide serves a dark one, but not the other way round (docs/theory/half_space.md).
std::array<double, 3> channel_shares(const PlanarExperiment& experiment, const std::vector<Guide>& guides);

/// The adjoint of a window, and the value that walks are expected to bring.
struct Window {
    std::unique_ptr<PlanarAdjoint> adjoint;
    double reference = 1;
};
Window make_window(const PlanarExperiment& experiment, const PlanarSlab& slab);
PlanarSurvival make_survival(const PlanarExperiment& experiment, const Window& window);

/// Builds the sampler of a name for every channel and calls use(samplers, guides).
template <class Use>
auto with_samplers(const PlanarExperiment& e, const Use& use) {
    const std::size_t channels = e.albedo.size();
    std::vector<Guide> guides(channels);
    std::vector<double> albedo(channels);
    for (std::size_t c = 0; c < channels; ++c) {
        guides[c].slab = make_slab(e, c);
        albedo[c] = guide_albedo(e, c, guides[c].slab.thickness);
    }
    const Heading heading = heading_of(e);
    const auto build = [&](const auto& make) {
        std::vector<decltype(make(std::size_t{0}))> samplers;
        for (std::size_t c = 0; c < channels; ++c) {
            samplers.push_back(make(c));
        }
        return use(samplers, guides);
    };
    // Samplers that know only where to head for.
    const auto stretching = [&](std::size_t c, double first, double stretch, auto direction) {
        const double thickness = guides[c].slab.thickness;
        return PlanarSampler<PathStretching, decltype(direction)>{
            make_entry(e, guides[c].slab, nullptr), PathStretching(thickness, heading, first),
            PathStretching(thickness, heading, stretch), std::move(direction), ClassicalCrossing(guides[c].slab)};
    };
    const auto eigenvalue = [&](std::size_t c) { return discrete_eigenvalue_henyey_greenstein(albedo[c], e.g); };

    if (e.sampler == "analog" || e.sampler == "classical") {
        return build([&](std::size_t c) { return stretching(c, 0, 0, PhaseDirection(e.g)); });
    }
    if (e.sampler == "stretched") {
        return build([&](std::size_t c) {
            const double stretch = e.stretch.value_or(std::min(eigenvalue(c).k, 0.999));
            return stretching(c, stretch, stretch, PhaseDirection(e.g));
        });
    }
    if (e.sampler == "dwivedi") {
        const double first = e.first_flight == FirstFlight::stretched ? 1 : 0;
        if (e.g == 0) {
            return build([&](std::size_t c) {
                const DiscreteEigenvalue nu = eigenvalue(c);
                return stretching(c, first * nu.k, nu.k, DwivediDirection(nu.gap, heading));
            });
        }
        return build([&](std::size_t c) {
            const DiscreteEigenvalue nu = eigenvalue(c);
            return stretching(c, first * nu.k, nu.k,
                              ModalDirection(asymptotic_radiance(albedo[c], e.g, nu.k, heading), e.g));
        });
    }
    return build([&](std::size_t c) {
        guides[c].adjoint = make_guide(e, albedo[c], guides[c].slab);
        const PlanarAdjoint& adjoint = *guides[c].adjoint;
        // Several channels need the density of crossing, which choosing among rough facets does not have.
        const bool classical_crossing = channels > 1 && e.roughness > 0;
        return PlanarSampler<ModalFlight, ModalDirection>{
            make_entry(e, guides[c].slab, &adjoint), ModalFlight(adjoint), ModalFlight(adjoint),
            ModalDirection(adjoint, e.g),
            classical_crossing ? PlanarCrossingDecision(ClassicalCrossing(guides[c].slab))
                               : PlanarCrossingDecision(GuidedCrossing(adjoint))};
    });
}

/// Calls use(walker) with a grey walker of the experiment.
template <class Use>
auto with_walker(const PlanarExperiment& e, const Use& use) {
    return with_samplers(e, [&](const auto& samplers, const std::vector<Guide>& guides) {
        using Sampler = std::remove_cvref_t<decltype(samplers[0])>;
        const Window window = e.window == PlanarWindow::adjoint ? make_window(e, guides[0].slab) : Window{};
        const PlanarSurvival survival = make_survival(e, window);
        if constexpr (std::is_same_v<decltype(Sampler::direction), PhaseDirection>) {
            if (e.sampler == "analog") {
                return use(
                    PlanarWalker<AnalogCapture, Sampler>({e.albedo[0], &guides[0].slab, &samplers[0], survival}));
            }
        }
        return use(PlanarWalker<ImplicitCapture, Sampler>({e.albedo[0], &guides[0].slab, &samplers[0], survival}));
    });
}

}  // namespace wend::planar_build
