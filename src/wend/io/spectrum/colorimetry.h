// How spectra become colours. Scene files give some quantities as spectra; the renderer has three channels.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/colour_matrix.h>

#include <functional>
#include <span>
#include <vector>

namespace wend {

/// A spectrum as points of a polygon over the wavelength, 0 outside it.
struct SpectrumSample {
    float wavelength;  ///< in nanometres
    float value;
};

/// What a spectrum means, and so how it is reduced to Rgb:
/// - reflectance: the colour that a surface of this reflectance has under daylight D65. A constant v gives Rgb(v).
/// Colours that no
///   display shows are clamped to [0, 1].
/// - unbounded (extinction, absorption, index of refraction): the same without an upper limit.
/// - illuminant: the colour of light of this spectrum, scaled to luminance 1 as pbrt scales the spectra of lights; what
/// scales
///   it further is up to the scene. Negative channels are clamped to 0, which raises the luminance of very saturated
///   light.
enum class SpectrumKind { reflectance, unbounded, illuminant };

/// Throws InputError if there are no samples, wavelengths do not increase, or a value is negative or not finite.
Rgb rgb_from_pairs(std::span<const SpectrumSample> samples, SpectrumKind kind);

/// The same for a spectrum as a function of the wavelength in nanometres.
Rgb rgb_from_spectrum(const std::function<double(double)>& spectrum, SpectrumKind kind);

/// The colour that a surface of a reflectance has under daylight D65, not clamped: in proportion to the reflectance.
Rgb rgb_of_reflectance(const std::function<double(double)>& spectrum);

/// The spectrum that samples stand for. Throws InputError as rgb_from_pairs().
std::function<double(double)> spectrum_from_pairs(std::vector<SpectrumSample> samples);

/// Tristimulus values.
struct Xyz {
    double x = 0, y = 0, z = 0;
};

/// Integrals of a spectrum times the matching functions of the CIE 1931 standard observer, over nanometres from 360 to
/// 830. The functions are the fits of wyman2013, eq. 4 and table 1 (error of chromaticities about 0.003), with x and z
/// scaled so that D65 is the white of Rec. 709 exactly.
Xyz xyz_from_spectrum(const std::function<double(double)>& spectrum);

/// Rec. 709 primaries, not clamped.
Rgb rgb_from_xyz(const Xyz& xyz);
/// The same as a matrix, but for the rounding of white.
const ColourMatrix& rgb_from_xyz_matrix();

/// The colour of luminance 1 and chromaticity (x, y), with negative channels clamped to 0.
Rgb rgb_from_chromaticity(double x, double y);

}  // namespace wend
