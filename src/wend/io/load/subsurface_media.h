// What is inside of pbrt's material "subsurface".
#pragma once

#include <wend/io/load/context.h>
#include <wend/io/load/textures.h>
#include <wend/medium/medium.h>
#include <wend/scene/material.h>

namespace wend {

/// By any of pbrt's four ways to say it: by name, by coefficients, by colour and mean free path, or not at all. A
/// colour that varies goes to the boundary. Throws InputError for one coefficient of two, and what
/// load_mean_free_path() does.
HomogeneousMedium load_inside(LoadContext& context, TextureLoader& textures, const pbrt::MaterialEntity& entity,
                              DielectricMaterial& boundary);

/// "mfp", or 1, times a scale. Throws InputError where that is not above 0.
Rgb load_mean_free_path(LoadContext& context, TextureLoader& textures, const pbrt::ParameterSet& p, float scale);

}  // namespace wend
