#pragma once

#include <wend/core/colour.h>
#include <wend/io/spectrum/colorimetry.h>

namespace wend {

/// The colour of a black body, scaled to luminance 1, as pbrt does with "blackbody L" of lights. Negative channels are
/// clamped to 0 (blue below some 1950 K). `temperature` in kelvin. Throws InputError unless it is positive and finite.
Rgb blackbody_rgb(double temperature);

/// The same spectrum, scaled to a peak of 1, as a reflectance or another quantity that is no light: pbrt takes any
/// spectrum for them. Throws InputError likewise.
Rgb blackbody_reflectance(double temperature, SpectrumKind kind);

/// Tristimulus values of a black body whose radiance is 1 where it is largest over all wavelengths. `temperature` must
/// be positive.
Xyz blackbody_xyz(double temperature);

/// What pbrt's rgb film shows of an emissive medium of this temperature with LeScale 1. There the emitted radiance is
/// Planck's law scaled to a peak of 1 over all wavelengths, and, other than for lights, it is not divided by its
/// photometric integral: the tristimulus values are its integrals with the matching functions over nanometres (imaging
/// ratio 1), so that a spectrum of 1 everywhere would have luminance 106.9. Black for temperatures that are not
/// positive; negative channels are clamped to 0.
Rgb blackbody_emission(double temperature);

}  // namespace wend
