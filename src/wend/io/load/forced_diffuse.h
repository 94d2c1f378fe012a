// pbrt's option "forcediffuse".
#pragma once

#include <wend/io/load/materials.h>

#include <vector>

namespace wend {

/// pbrt's option "forcediffuse": all that scatters reflects diffusely, as much as it does of light from above. Of what
/// is no diffuse material the textures are taken at one point.
void force_diffuse(std::vector<LoadedMaterial>& materials, Textures& textures);

}  // namespace wend
