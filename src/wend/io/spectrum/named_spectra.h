// The spectra that pbrt files refer to by name: metals, glasses, standard illuminants.
#pragma once

#include <wend/core/colour.h>

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// The value of a named spectrum, reduced to Rgb:
/// - metal-M-eta, metal-M-k: index of refraction and absorption index, averaged as SpectrumKind::unbounded;
/// - glass-G: index of refraction, likewise;
/// - stdillum-I, illum-acesD60: the colour of the light at luminance 1.
/// Nothing for an unknown name: in a pbrt file it may be that of a spectrum file.
std::optional<Rgb> find_named_spectrum(std::string_view name);

/// The same; throws InputError listing the names that are known.
Rgb named_spectrum(std::string_view name);

/// metal-M-eta or metal-M-k by wavelength, in nanometres; empty for other names.
std::function<double(double)> find_metal_constant(std::string_view name);

/// Index of refraction of a named glass at the d line, 587.6 nm: for a dielectric without dispersion. Nothing if there
/// is no such glass.
std::optional<float> glass_index(std::string_view name);

std::vector<std::string> spectrum_names();

}  // namespace wend
