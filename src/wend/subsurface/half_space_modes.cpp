#include <wend/core/error.h>
#include <wend/planar/discrete_mode.h>
#include <wend/subsurface/half_space_mode.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

constexpr int levels = 8;
// Where little is scattered, a walk made for more of it has the smaller variance: docs/theory/subsurface.md.
constexpr double least_albedo = 0.65;
// Between the directions of most and least light.
constexpr float most_contrast = 40;

HalfSpaceMode mode_of(double albedo, const PhaseFunction& phase) {
    std::vector<double> moments;
    for (int l = 0; l <= 256; ++l) {
        moments.push_back(phase.moment(l));
    }
    // Those in between may vanish, as every other does where forward and backward scattering balance.
    while (moments.size() > 1 && std::abs(moments.back()) < 1e-14) {
        moments.pop_back();
    }
    const DiscreteMode mode = discrete_mode(albedo, moments);
    return {mode.k, mode.albedo, mode.source};
}

}  // namespace

std::vector<HalfSpaceMode> half_space_modes(double albedo, const PhaseFunction& phase) {
    double absorbed = 1 - std::clamp(albedo, least_albedo, 1.0);
    while (mode_of(1 - absorbed, phase).contrast() > most_contrast) {
        absorbed *= 0.75;
    }
    std::vector<HalfSpaceMode> modes(1);
    for (int i = 1; i <= levels; ++i) {
        modes.push_back(mode_of(1 - absorbed * i * i / (levels * levels), phase));
    }
    return modes;
}

std::vector<std::vector<HalfSpaceMode>> half_space_modes(const HomogeneousMedium& medium) {
    const Rgb extinction = medium.extinction();
    if (!is_finite(extinction) || !(min_value(medium.absorption) >= 0) || !(min_value(medium.scattering) >= 0)) {
        throw InputError("the modes of a medium: its coefficients must be finite and not negative");
    }
    const auto is_grey = [](const Rgb& c) { return c.r == c.g && c.g == c.b; };
    const int channels = is_grey(medium.absorption) && is_grey(medium.scattering) ? 1 : 3;
    std::vector<std::vector<HalfSpaceMode>> modes;
    for (int c = 0; c < channels; ++c) {
        const double albedo =
            extinction[c] > 0 ? static_cast<double>(medium.scattering[c]) / static_cast<double>(extinction[c]) : 0.0;
        modes.push_back(half_space_modes(albedo, medium.phase));
    }
    return modes;
}

}  // namespace wend
