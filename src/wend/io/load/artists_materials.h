// Surfaces of artists' programs, by their parameters.
#pragma once

#include <wend/io/load/textures.h>
#include <wend/scene/material.h>

namespace wend {

/// "principled", but for indices and what is inside.
PrincipledMaterial principled_surface(TextureLoader& textures, const pbrt::ParameterSet& p);

/// "burley", but for the index.
DisneyMaterial disney_surface(TextureLoader& textures, const pbrt::ParameterSet& p);

/// "burleysheet", but for the index.
DisneySheetMaterial disney_sheet(TextureLoader& textures, const pbrt::ParameterSet& p);

}  // namespace wend
