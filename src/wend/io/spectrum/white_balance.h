#pragma once

#include <wend/core/colour_matrix.h>

namespace wend {

/// What makes daylight of this temperature, in kelvin, the white of Rec. 709, as pbrt's films do it: each response of
/// the eye is scaled, by those of the Bradford transform (lam1985). Below 4000 K, where the CIE's daylight ends, it is
/// the white of a black body. Throws InputError unless the temperature lies in [1000, 100000].
ColourMatrix white_balance(double temperature);

}  // namespace wend
