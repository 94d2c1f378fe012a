// Directives of lights at infinity that shine from everywhere.
#pragma once

#include <wend/io/load/textures.h>
#include <wend/scene/light.h>

namespace wend {

/// An "infinite" light: even, a picture, or what is seen through a portal. Throws InputError, as load_light().
Light load_infinite(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light);

}  // namespace wend
