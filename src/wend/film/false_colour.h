// Colours for numbers: error maps.
#pragma once

#include <wend/core/image.h>

#include <vector>

namespace wend {

/// How a number becomes a position on the colour map: `low` is its dark end, `high` its light end, values outside take
/// the ends.
struct ColourScale {
    enum class Kind { linear, logarithmic };

    Kind kind = Kind::linear;
    float low = 0;
    float high = 1;

    /// Position in [0,1]. NaN is at the light end: what went wrong must not look fine.
    float position(float value) const;
};

/// The colour at a position in [0,1] as linear colour: from near black over violet, magenta and orange to pale yellow.
/// Perceived lightness grows in proportion to the position (Oklab, ottosson2020), so larger always looks lighter, in
/// grey as well.
Rgb false_colour(float position);

/// A picture of `values` (row-major, width · height of them) in false colours. Throws InputError where the count does
/// not match or the scale is empty (low >= high, or low <= 0 for a logarithmic one).
Image false_colour(const std::vector<float>& values, int width, int height, const ColourScale& scale);

}  // namespace wend
