#include <wend/io/spectrum/blackbody.h>

#include <wend/core/error.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Planck's law over wavelength (in nanometres), divided by its maximum.
double relative_radiance(double wavelength, double temperature) {
    constexpr double second_radiation_constant = 1.438776877e7;  // nm K
    constexpr double wien_displacement = 2.897771955e6;          // nm K
    const double peak = wien_displacement / temperature;
    const double ratio = peak / wavelength;
    return std::pow(ratio, 5) * std::expm1(second_radiation_constant / wien_displacement) /
           std::expm1(second_radiation_constant / (wavelength * temperature));
}

Rgb reduce(double temperature, SpectrumKind kind) {
    if (!(temperature > 0) || !std::isfinite(temperature)) {
        throw InputError(fmt::format("a black body of {} K: the temperature must be positive", temperature));
    }
    return rgb_from_spectrum([=](double w) { return relative_radiance(w, temperature); }, kind);
}

}  // namespace

Rgb blackbody_rgb(double temperature) {
    return reduce(temperature, SpectrumKind::illuminant);
}

Rgb blackbody_reflectance(double temperature, SpectrumKind kind) {
    return reduce(temperature, kind);
}

Xyz blackbody_xyz(double temperature) {
    return xyz_from_spectrum([=](double w) { return relative_radiance(w, temperature); });
}

Rgb blackbody_emission(double temperature) {
    if (!(temperature > 0)) {
        return {};
    }
    const Rgb rgb = rgb_from_xyz(blackbody_xyz(temperature));
    return {std::max(rgb.r, 0.0f), std::max(rgb.g, 0.0f), std::max(rgb.b, 0.0f)};
}

}  // namespace wend
