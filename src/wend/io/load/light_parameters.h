// What several kinds of lights take.
#pragma once

#include <wend/io/load/textures.h>

#include <string_view>

namespace wend {

/// pbrt's "power" and "illuminance": 0 where the parameter is absent or not positive, which pbrt takes for absent.
/// Throws InputError where it is not finite.
float load_target(const pbrt::ParameterSet& p, std::string_view name);

/// A colour parameter times "scale"; white where it is absent.
Rgb load_scaled(LoadContext& context, const pbrt::ParameterSet& p, std::string_view name);

/// The picture that a light shines by, as pbrt clamps it. Throws InputError where a pixel is not finite.
Image load_picture(LoadContext& context, TextureLoader& textures, const pbrt::Entity& light);

/// Throws InputError where it is not.
void require_square(const Image& image, const pbrt::Entity& light);

}  // namespace wend
