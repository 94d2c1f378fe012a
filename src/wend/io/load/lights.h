// Directives of lights.
#pragma once

#include <wend/io/load/area_lights.h>
#include <wend/io/load/textures.h>
#include <wend/scene/light.h>

#include <optional>

namespace wend {

/// The light of a LightSource directive; none where it is black. Throws InputError for unknown types, missing, broken
/// or unsuitable pictures, and values that are negative or not finite.
std::optional<Light> load_light(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light);

/// Throws InputError, as above.
AreaLight load_area_light(LoadContext& context, TextureLoader& textures, const pbrt::Entity& light);

}  // namespace wend
