#include <wend/lab/build.h>

#include <wend/core/error.h>
#include <wend/numeric/legendre.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend::planar_build {
namespace {

/// Thicker slabs transmit less than a double can say.
constexpr double thickest = 600;
/// Of a mode of a caller's own adjoint.
constexpr std::size_t most_shape_coefficients = 256;

void require(bool condition, const std::string& message) {
    if (!condition) {
        throw InputError(message);
    }
}

/// Of a caller's own adjoint: PlanarAdjoint::keep_positive makes what is left of it one that can be sampled.
void validate_adjoint(const PlanarExperiment& e) {
    const std::vector<PlanarModes::Mode>& modes = e.adjoint->modes;
    require(e.sampler == "modes", "an adjoint is followed by the sampler 'modes' alone");
    require(e.albedo.size() == 1, "an adjoint is for one channel");
    require(!e.guide_albedo, "give an adjoint, or the albedo that one is made for");
    require(!modes.empty() && modes.size() <= PlanarAdjoint::max_modes,
            fmt::format("adjoint: {} modes, expected 1 to {}", modes.size(), PlanarAdjoint::max_modes));
    const auto is_plain = [](double x) { return std::abs(x) <= 1e30; };  // neither infinite nor NaN
    for (std::size_t k = 0; k < modes.size(); ++k) {
        const PlanarModes::Mode& mode = modes[k];
        const std::string name = fmt::format("mode {} of the adjoint: ", k + 1);
        require(mode.length > 0, name + "expected a positive length");
        require(is_plain(mode.near) && is_plain(mode.far), name + "its amplitudes are not finite");
        require(mode.far == 0 || !std::isinf(e.thickness), name + "in a half-space nothing grows with depth");
        require(!mode.shape.empty() && mode.shape.size() <= most_shape_coefficients &&
                    std::all_of(mode.shape.begin(), mode.shape.end(), is_plain),
                name + fmt::format("expected 1 to {} finite coefficients of its shape", most_shape_coefficients));
    }
    // What has no part of it that is positive everywhere cannot be made positive, and would leave directions out.
    require(
        std::is_sorted(modes.begin(), modes.end(), [](const auto& a, const auto& b) { return a.length > b.length; }),
        "the modes of an adjoint must come longest first");
    const PlanarModes::Mode& longest = modes.front();
    bool is_positive = longest.near >= 0 && longest.far >= 0 && longest.near + longest.far > 0;
    constexpr int cosines = 256;
    std::vector<double> p(longest.shape.size());
    for (int i = 0; i <= cosines; ++i) {
        legendre_polynomials(2.0 * i / cosines - 1, p);
        is_positive &= std::inner_product(p.begin(), p.end(), longest.shape.begin(), 0.0) > 0;
    }
    require(is_positive, "the longest mode of an adjoint must be positive in every direction");
}

}  // namespace

bool is_half_space(const PlanarExperiment& experiment) {
    return std::isinf(experiment.thickness);
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
    if (e.adjoint) {
        validate_adjoint(e);
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

double guide_albedo(const PlanarExperiment& e, std::size_t channel, double thickness) {
    const double albedo = e.guide_albedo.value_or(e.albedo[channel]);
    if (std::isinf(thickness)) {
        return albedo;
    }
    // In a slab of little absorption the falling and the growing long mode almost cancel, which sampling by rejection
    // pays for: its guide is made for a little more absorption.
    constexpr double least_decay = 0.3, always_fine = 0.9;
    const double rate = least_decay / (thickness + 1.42 / (1 - e.g));
    return std::min(albedo, std::max(1 - rate * rate / (3 * (1 - e.g)), always_fine));
}

PlanarEntry make_entry(const PlanarExperiment& e, const PlanarSlab& slab, const PlanarAdjoint* adjoint) {
    return e.mu0 ? PlanarEntry(slab, *e.mu0) : PlanarEntry(slab, adjoint);
}

Heading heading_of(const PlanarExperiment& e) {
    return e.tally == Tally::reflectance ? Heading::near : Heading::far;
}

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

std::unique_ptr<PlanarAdjoint> make_guide(const PlanarExperiment& e, double albedo, const PlanarSlab& slab) {
    const bool few = e.sampler == "boundary";
    PlanarModes modes =
        e.adjoint ? *e.adjoint : solve_planar(make_problem(albedo, e.g, slab, few ? reference_transients : e.modes));
    if (few) {
        const bool lit_at_far = heading_of(e) == Heading::far;
        modes = e.exponentials == 1 ? match_one_exponential(modes, slab.thickness, lit_at_far, e.moments)
                                    : match_two_exponentials(modes, slab.thickness, lit_at_far);
    }
    auto adjoint = std::make_unique<PlanarAdjoint>(modes, slab);
    adjoint->keep_positive();
    return adjoint;
}

std::array<double, 3> channel_shares(const PlanarExperiment& e, const std::vector<Guide>& guides) {
    constexpr int transients = 8;
    constexpr double least = 1e-3;
    std::array<double, 3> shares{};
    double total = 0;
    for (std::size_t c = 0; c < shares.size(); ++c) {
        const PlanarSlab& slab = guides[c].slab;
        const PlanarAdjoint adjoint(solve_planar(make_problem(e.albedo[c], e.g, slab, transients)), slab);
        const double expected = make_entry(e, slab, nullptr).expected(adjoint);
        shares[c] = expected;
        total += shares[c];
    }
    for (double& share : shares) {
        share = (share / std::max(total, 1e-300) + least) / (1 + 3 * least);
    }
    const double sum = shares[0] + shares[1] + shares[2];
    return {shares[0] / sum, shares[1] / sum, shares[2] / sum};
}

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

}  // namespace wend::planar_build
