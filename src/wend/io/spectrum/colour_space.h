// The spaces in which scene files write colours, and in which films hold them.
#pragma once

#include <wend/core/colour_matrix.h>
#include <wend/io/pbrt/colour_value.h>

#include <array>
#include <string_view>

namespace wend {

/// Chromaticities.
struct Primaries {
    struct Point {
        double x, y;
    };
    Point red, green, blue, white;
};
const Primaries& primaries_of(pbrt::ColourSpace space);

/// What the metadata of a picture call the text that names the space of its colours; without it, that is sRGB's.
inline constexpr std::string_view colour_space_text = "wend:colour_space";

/// To colours of Rec. 709, which may be negative. `keeps_white`: what is white in the space is white in Rec. 709;
/// otherwise light stays what it is.
const ColourMatrix& rec709_from(pbrt::ColourSpace space, bool keeps_white);

}  // namespace wend
