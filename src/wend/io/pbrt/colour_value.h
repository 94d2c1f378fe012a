// The ways a pbrt scene file writes a colour.
#pragma once

#include <wend/core/colour.h>

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace wend::pbrt {

/// The RGB spaces of the ColorSpace directive.
enum class ColourSpace { srgb, dci_p3, rec2020, aces2065_1 };

std::string_view to_string(ColourSpace space);
/// In any case ("sRGB"), as in pbrt; none for an unknown name.
std::optional<ColourSpace> colour_space_named(std::string_view name);

/// Linear RGB in its space.
struct RgbColour {
    Rgb value;
    ColourSpace space = ColourSpace::srgb;
};

/// Values at wavelengths in nm, which increase strictly.
struct SampledSpectrum {
    std::vector<float> wavelengths;
    std::vector<float> values;
};

/// The name of a spectrum that pbrt knows ("metal-Ag-eta", "stdillum-D65"), or of a file of wavelengths and values.
struct NamedSpectrum {
    std::string name;
};

/// Emission of a black body at this temperature in kelvin, above 0.
struct Blackbody {
    float temperature = 0;
};

using ColourValue = std::variant<RgbColour, SampledSpectrum, NamedSpectrum, Blackbody>;

/// A reference to a texture, which stands in the place of a value.
struct TextureName {
    std::string name;
};

}  // namespace wend::pbrt
