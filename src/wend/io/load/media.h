#pragma once

#include <wend/io/load/context.h>
#include <wend/io/spectrum/medium_presets.h>
#include <wend/medium/medium.h>

#include <string_view>

namespace wend {

/// A medium of a scene file. Throws InputError for an unknown type, a missing or broken file, grids of the wrong or an
/// absurd size, and values out of range: negative or not finite coefficients or densities, |g| >= 1. Beyond pbrt,
/// "phase" names a phase function (load_phase()).
Medium load_medium(LoadContext& context, const pbrt::MediumEntity& medium);

/// The parameter "g"; InputError unless it lies within (-1, 1). Beyond 0.99 either way, where the phase function is too
/// sharp for single precision, 0.99 takes its place as in pbrt, with a warning.
float load_mean_cosine(LoadContext& context, const pbrt::ParameterSet& parameters);

/// The measured medium that a string parameter names. Throws InputError for an unknown name.
MediumPreset required_preset(const pbrt::ParameterSet& parameters, std::string_view name);

}  // namespace wend
