#pragma once

#include <wend/core/colour_matrix.h>

#include <array>

namespace wend {

/// Of tristimulus values: makes one white another one, by scaling each response of the eye (Bradford transform,
/// lam1985).
ColourMatrix adaptation(const std::array<double, 3>& from, const std::array<double, 3>& to);

/// What makes daylight of this temperature, in kelvin, the white of Rec. 709, as pbrt's films do it: each response of
/// the eye is scaled, by those of the Bradford transform (lam1985). Below 4000 K, where the CIE's daylight ends, it is
/// the white of a black body. Throws InputError unless the temperature lies in [1000, 100000].
ColourMatrix white_balance(double temperature);

/// What pbrt's measured sensors make of it: the sensor's responses to the patches of a colour chart in that daylight,
/// mapped to the patches' colours in the white of Rec. 709 by least squares, for scenes whose light is about white.
/// This is the matrix of the Nikon D850; other cameras differ from it less than from the standard observer.
ColourMatrix sensor_balance(double temperature);

}  // namespace wend
