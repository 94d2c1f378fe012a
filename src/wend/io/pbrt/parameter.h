#pragma once

#include <wend/io/pbrt/colour_value.h>
#include <wend/io/pbrt/location.h>

#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace wend::pbrt {

enum class ParameterType {
    real,  ///< spelled "float"
    integer,
    boolean,  ///< spelled "bool"
    string,
    point2,
    vector2,
    point3,
    vector3,
    normal3,
    rgb,
    spectrum,
    blackbody,
    texture
};

/// The type's spelling in a file.
std::string_view to_string(ParameterType type);
/// The type spelled so, with pbrt's synonyms point, vector and normal, and pbrt-v3's color; none for an unknown one.
std::optional<ParameterType> parameter_type_named(std::string_view name);
/// All spellings, for messages.
std::string parameter_type_names();
/// How many numbers make one element: 3 for a point3, 2 for the (wavelength, value) pairs of a spectrum, 1 for a
/// string.
int components_of(ParameterType type);

/// Flat values: a point3 is three floats, a sampled spectrum alternates wavelengths and values.
using ParameterValues = std::variant<std::vector<float>, std::vector<int>, std::vector<bool>, std::vector<std::string>>;

/// `"type name" values` as written. The values are never empty and make whole elements.
struct Parameter {
    ParameterType type = ParameterType::real;
    std::string name;
    Location place;
    ColourSpace colour_space = ColourSpace::srgb;  ///< that of the statement
    ParameterValues values;
    bool looked_up = false;

    /// How many elements (of components_of(type) numbers) it holds.
    std::size_t count() const;
};

}  // namespace wend::pbrt
