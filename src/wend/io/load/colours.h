// Colours of scene files as the three channels that Wend computes with.
#pragma once

#include <wend/core/colour.h>
#include <wend/io/load/context.h>
#include <wend/io/spectrum/colorimetry.h>

#include <functional>
#include <optional>
#include <string_view>
#include <vector>

namespace wend {

/// A colour of a scene file. RGB is converted to Rec. 709 primaries, whose white is that of all spaces but for light,
/// and otherwise taken as it stands; spectra are reduced by their kind, light to luminance 1 (as are black bodies).
/// Throws InputError at the parameter where a channel is negative or not finite, or the name is neither that of a known
/// spectrum nor of a file of wavelengths and values.
std::optional<Rgb> get_colour(const LoadContext& context, const pbrt::ParameterSet& parameters, std::string_view name,
                              SpectrumKind kind);

/// A colour of a space in Rec. 709; where that cannot show it, clamped to its faces. The white of a space is white but
/// for light.
Rgb rec709_of(const pbrt::RgbColour& colour, SpectrumKind kind);

/// What light is that has no colour of its own: the white of the directive's colour space.
Rgb default_light(const pbrt::ParameterSet& parameters);

/// The same for a value that was looked up already, at this place.
Rgb reduce_colour(const LoadContext& context, const pbrt::ColourValue& value, SpectrumKind kind,
                  const pbrt::Location& place);

/// A parameter that is given by wavelength, in nanometres: a metal's constant by name, samples or a file of them. Empty
/// where it is absent or given otherwise.
std::function<double(double)> find_spectrum(const LoadContext& context, const pbrt::ParameterSet& parameters,
                                            std::string_view name);

/// What a medium of temperature 0, `step`, 2 `step`, ... kelvin emits, up to `hottest` or 40000 K, above which the
/// colour hardly changes; at least two values.
std::vector<Rgb> glow_by_temperature(float step, float hottest);

}  // namespace wend
