#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/decision/planar_modes.h>
#include <wend/integrator/planar_chromatic.h>
#include <wend/integrator/planar_lab.h>
#include <wend/integrator/planar_walk.h>
#include <wend/numeric/legendre.h>
#include <wend/theory/discrete_ordinates.h>
#include <wend/theory/eigenvalue.h>

#include <fmt/format.h>

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <numbers>

namespace wend {
namespace {

constexpr int reference_transients = 63;
/// Thicker slabs transmit less than a double can say.
constexpr double thickest = 600;

bool is_half_space(const PlanarExperiment& experiment) {
    return std::isinf(experiment.thickness);
}

void require(bool condition, const std::string& message) {
    if (!condition) {
        throw InputError(message);
    }
}

void validate(const PlanarExperiment& e) {
    require(e.albedo.size() == 1 || e.albedo.size() == 3, "albedo: expected one value, or three for three channels");
    for (const double c : e.albedo) {
        require(c >= 0 && c <= 1, fmt::format("albedo {}: expected a value in [0, 1]", c));
    }
    require(e.extinction.size() == 1 || e.extinction.size() == e.albedo.size(),
            "extinction: expected one value, or as many as albedos");
    for (const double s : e.extinction) {
        require(s >= 1e-3 && s <= 1e3, fmt::format("extinction {}: expected a value in [0.001, 1000]", s));
    }
    require(std::abs(e.g) <= 0.95, fmt::format("g {}: expected a mean cosine in [-0.95, 0.95]", e.g));
    require(e.ior >= 1 && e.ior <= 3, fmt::format("ior {}: expected a refractive index in [1, 3]", e.ior));
    require(e.roughness == 0 || (e.roughness >= 0.05 && e.roughness <= 1),
            fmt::format("roughness {}: expected 0, or a value in [0.05, 1]", e.roughness));
    require(e.roughness == 0 || e.ior >= 1.01, "roughness: a matched boundary has none; give an --ior of 1.01 or more");
    require(is_half_space(e) ? e.thickness > 0 : (e.thickness >= 1e-6 && e.thickness <= thickest),
            fmt::format("thickness {}: expected a value in [1e-6, {}] mean free paths", e.thickness, thickest));
    require(e.tally == Tally::reflectance || !is_half_space(e),
            "a half-space transmits nothing: tally its reflectance");
    require(!e.mu0 || (*e.mu0 > 0 && *e.mu0 <= 1),
            fmt::format("mu0 {}: expected a cosine in (0, 1]", e.mu0.value_or(0)));
    require(!e.stretch || (*e.stretch >= 0 && *e.stretch < 1),
            fmt::format("stretch {}: expected a value in [0, 1)", e.stretch.value_or(0)));
    require(e.exponentials == 1 || e.exponentials == 2,
            fmt::format("exponentials {}: expected 1 or 2", e.exponentials));
    require(e.modes >= 0 && e.modes < PlanarAdjoint::max_modes,
            fmt::format("modes {}: expected a number in [0, {}]", e.modes, PlanarAdjoint::max_modes - 1));
    require(!e.guide_albedo || (*e.guide_albedo >= 0 && *e.guide_albedo <= 1),
            fmt::format("guide albedo {}: expected a value in [0, 1]", e.guide_albedo.value_or(0)));
    const auto& names = planar_samplers();
    if (std::find(names.begin(), names.end(), e.sampler) == names.end()) {
        std::string message = fmt::format("unknown sampler '{}': expected one of", e.sampler);
        for (const std::string& name : names) {
            message += ' ' + name;
        }
        throw InputError(message);
    }
    if (e.albedo.size() > 1) {
        require(e.sampler != "analog", "analog walks have one albedo: what would absorb one channel and not another?");
        require(e.window == PlanarWindow::none, "a window needs one expected contribution: give one albedo");
        require(!e.guide_albedo, "a guide for another albedo is for one channel");
    }
}

double extinction_of(const PlanarExperiment& e, std::size_t channel) {
    return e.extinction.size() == 1 ? e.extinction[0] : e.extinction[channel];
}

PlanarSlab make_slab(const PlanarExperiment& e, std::size_t channel) {
    PlanarSlab slab;
    slab.thickness = e.thickness * extinction_of(e, channel) / e.extinction[0];
    slab.near.ior = slab.far.ior = e.ior;
    if (e.roughness > 0) {
        slab.near.rough = slab.far.rough = std::make_shared<RoughBoundary>(e.ior, e.roughness);
    }
    (e.tally == Tally::reflectance ? slab.near : slab.far).illumination = [](double /*cosine*/) { return 1.0; };
    return slab;
}

PlanarProblem make_problem(double albedo, double g, const PlanarSlab& slab, int transients) {
    PlanarProblem problem;
    problem.albedo = albedo;
    problem.moments = henyey_greenstein_moments(g, g == 0 ? 1 : 2 * (transients + 1));
    problem.slab = slab;
    problem.transients = transients;
    return problem;
}

/// In a slab of little absorption the falling and the growing long mode almost cancel, which sampling by rejection pays
/// for: its guide is made for a little more absorption.
double guide_albedo(double albedo, double g, double thickness) {
    if (std::isinf(thickness)) {
        return albedo;
    }
    constexpr double least_decay = 0.3;
    const double rate = least_decay / (thickness + 1.42 / (1 - g));
    return std::min(albedo, std::max(1 - rate * rate / (3 * (1 - g)), 0.9));
}

PlanarEntry make_entry(const PlanarExperiment& e, const PlanarSlab& slab, const PlanarAdjoint* adjoint) {
    return e.mu0 ? PlanarEntry(slab, *e.mu0) : PlanarEntry(slab, adjoint);
}

/// What a sampler is made of, kept for as long as it is used.
struct Guide {
    PlanarSlab slab;
    std::unique_ptr<PlanarAdjoint> adjoint;
};

Heading heading_of(const PlanarExperiment& e) {
    return e.tally == Tally::reflectance ? Heading::near : Heading::far;
}

/// The radiance of the longest mode alone, by cosine, up to a factor.
std::function<double(double)> asymptotic_radiance(double albedo, double g, double k, Heading heading) {
    PlanarSlab unlit;
    unlit.near.illumination = [](double /*cosine*/) { return 1.0; };
    PlanarModes modes = solve_planar(make_problem(albedo, g, unlit, 31));
    return [shape = std::move(modes.modes[0].shape), k, heading](double mu) {
        const double along = heading == Heading::near ? mu : -mu;
        std::vector<double> p(shape.size());
        legendre_polynomials(along, p);
        double source = 0;
        for (std::size_t l = 0; l < p.size(); ++l) {
            source += shape[l] * p[l];
        }
        return source / (1 + k * along);
    };
}

/// Builds the sampler of a name for every channel and calls use(samplers, guides).
template <class Use>
auto with_samplers(const PlanarExperiment& e, const Use& use) {
    const std::size_t channels = e.albedo.size();
    std::vector<Guide> guides(channels);
    std::vector<double> albedo(channels);
    for (std::size_t c = 0; c < channels; ++c) {
        guides[c].slab = make_slab(e, c);
        albedo[c] = guide_albedo(e.guide_albedo.value_or(e.albedo[c]), e.g, guides[c].slab.thickness);
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
        const bool few = e.sampler == "boundary";
        PlanarModes modes =
            solve_planar(make_problem(albedo[c], e.g, guides[c].slab, few ? reference_transients : e.modes));
        if (few) {
            const bool lit_at_far = heading == Heading::far;
            modes = e.exponentials == 1 ? match_one_exponential(modes, guides[c].slab.thickness, lit_at_far, e.moments)
                                        : match_two_exponentials(modes, guides[c].slab.thickness, lit_at_far);
        }
        guides[c].adjoint = std::make_unique<PlanarAdjoint>(modes, guides[c].slab);
        PlanarAdjoint& adjoint = *guides[c].adjoint;
        adjoint.keep_positive();
        // Several channels need the density of crossing, which choosing among rough facets does not have.
        const bool classical_crossing = channels > 1 && e.roughness > 0;
        return PlanarSampler<ModalFlight, ModalDirection>{
            make_entry(e, guides[c].slab, &adjoint), ModalFlight(adjoint), ModalFlight(adjoint),
            ModalDirection(adjoint, e.g),
            classical_crossing ? PlanarCrossingDecision(ClassicalCrossing(guides[c].slab))
                               : PlanarCrossingDecision(GuidedCrossing(adjoint))};
    });
}

double thread_seconds() {
    timespec now{};
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
    return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

double wall_seconds() {
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

/// The adjoint of a window, and the value walks are expected to bring.
struct Window {
    std::unique_ptr<PlanarAdjoint> adjoint;
    double reference = 1;
};

Window make_window(const PlanarExperiment& e, const PlanarSlab& slab) {
    Window window;
    window.adjoint =
        std::make_unique<PlanarAdjoint>(solve_planar(make_problem(e.albedo[0], e.g, slab, std::max(e.modes, 8))), slab);
    window.reference = make_entry(e, slab, nullptr).expected(*window.adjoint);
    return window;
}

PlanarSurvival make_survival(const PlanarExperiment& e, const Window& window) {
    switch (e.window) {
        case PlanarWindow::adjoint:
            if (window.reference > 0) {
                return PlanarSurvival(AdjointWindow{window.adjoint.get(), window.reference, {}});
            }
            break;
        case PlanarWindow::weight:
            return PlanarSurvival(WeightRoulette{});
        case PlanarWindow::none:
            break;
    }
    return e.sampler == "classical" ? PlanarSurvival(LowWeightRoulette{}) : PlanarSurvival(EndlessSurvival{});
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

/// Sums over blocks of walks of fixed size, each with random numbers of its own, merged in order.
constexpr std::uint64_t block_size = 2048;

struct Block {
    std::vector<Moments> channels;
    std::uint64_t collisions = 0;
    std::uint64_t rejected = 0;
    double seconds = 0;
};

/// walk(random, collisions, values) fills the values of one walk.
PlanarResult run_blocks(std::size_t channels, const PlanarRun& run, const auto& walk) {
    const std::uint64_t count = (run.walks + block_size - 1) / block_size;
    std::vector<Block> blocks(count);
    parallel_for(count, run.threads, [&](std::size_t b) {
        Block& block = blocks[b];
        block.channels.resize(channels);
        const double begin = thread_seconds();
        Pcg32 random(hash_of(run.seed, b));
        std::vector<double> values(channels);
        const std::uint64_t first = b * block_size;
        for (std::uint64_t i = first; i < std::min(first + block_size, run.walks); ++i) {
            walk(random, block.collisions, values);
            for (std::size_t c = 0; c < channels; ++c) {
                const bool finite = std::isfinite(values[c]);
                block.rejected += finite ? 0 : 1;
                block.channels[c].add(finite ? values[c] : 0);
            }
        }
        block.seconds = thread_seconds() - begin;
    });
    PlanarResult result;
    result.channels.resize(channels);
    std::uint64_t collisions = 0;
    for (const Block& block : blocks) {
        for (std::size_t c = 0; c < channels; ++c) {
            result.channels[c].merge(block.channels[c]);
        }
        collisions += block.collisions;
        result.rejected += block.rejected;
        result.seconds += block.seconds;
    }
    result.collisions_per_walk = run.walks > 0 ? static_cast<double>(collisions) / static_cast<double>(run.walks) : 0;
    return result;
}

}  // namespace

const std::vector<std::string>& planar_samplers() {
    static const std::vector<std::string> names = {"analog", "classical", "stretched", "dwivedi", "boundary", "modes"};
    return names;
}

PlanarResult run_planar(const PlanarExperiment& e, const PlanarRun& run) {
    validate(e);
    const double begin = wall_seconds();
    double setup = 0;
    PlanarResult result;
    if (e.albedo.size() == 1) {
        result = with_walker(e, [&](const auto& walker) {
            setup = wall_seconds() - begin;
            return run_blocks(1, run, [&](Pcg32& random, std::uint64_t& collisions, std::vector<double>& values) {
                UnobservedWalk nobody;
                values[0] = walker.walk(random, collisions, nobody);
            });
        });
    } else {
        result = with_samplers(e, [&](const auto& samplers, const std::vector<Guide>& guides) {
            using Walker = ChromaticPlanarWalker<std::remove_cvref_t<decltype(samplers[0])>>;
            std::array<typename Walker::Channel, Walker::channels> channels;
            for (std::size_t c = 0; c < channels.size(); ++c) {
                channels[c] = {e.albedo[c], extinction_of(e, c), &guides[c].slab, &samplers[c]};
            }
            const Walker walker(channels, make_survival(e, {}));
            setup = wall_seconds() - begin;
            return run_blocks(3, run, [&](Pcg32& random, std::uint64_t& collisions, std::vector<double>& values) {
                const auto value = walker.walk(random, collisions);
                std::copy(value.begin(), value.end(), values.begin());
            });
        });
    }
    result.setup_seconds = setup;
    result.exact = planar_exact(e);
    return result;
}

std::vector<double> planar_exact(const PlanarExperiment& e) {
    validate(e);
    std::vector<double> exact;
    for (std::size_t c = 0; c < e.albedo.size(); ++c) {
        if (is_half_space(e) && e.ior == 1 && e.g == 0) {
            exact.push_back(e.mu0 ? reflectance(e.albedo[c], *e.mu0) : diffuse_reflectance(e.albedo[c]));
            continue;
        }
        const PlanarSlab slab = make_slab(e, c);
        const PlanarEntry entry = make_entry(e, slab, nullptr);
        const PlanarAdjoint adjoint(solve_planar(make_problem(e.albedo[c], e.g, slab, reference_transients)), slab);
        exact.push_back(entry.expected(adjoint) + entry.expected_reflection());
    }
    return exact;
}

}  // namespace wend
