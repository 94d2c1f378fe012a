// Measured materials that pbrt files refer to by name: the `preset` of a medium and the `name` of a subsurface
// material.
#pragma once

#include <wend/core/colour.h>

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// Coefficients per millimetre.
struct MediumPreset {
    Rgb sigma_a;        ///< absorption
    Rgb sigma_prime_s;  ///< reduced scattering: sigma_s (1 - g), to be used with isotropic scattering
};

/// Measurements of jensen2001 (Apple to Wholemilk) and narasimhan2006 (the others). Nothing for an unknown name.
std::optional<MediumPreset> medium_preset(std::string_view name);

std::vector<std::string> medium_preset_names();

}  // namespace wend
