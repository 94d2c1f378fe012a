#pragma once

#include <wend/io/load/textures.h>
#include <wend/scene/light.h>
#include <wend/scene/scene.h>

#include <optional>

namespace wend {

/// The light of a LightSource directive; none where it is black. Throws InputError for unknown types, missing, broken
/// or unsuitable pictures, and values that are negative or not finite.
std::optional<Light> load_light(LoadContext& context, TextureLoader& textures, const pbrt::LightEntity& light);

/// What an AreaLightSource directive asks of the shapes that follow it.
struct AreaLight {
    Rgb radiance;
    /// Where positive, the power that each shape (of a mesh, each triangle) emits if `radiance` has luminance 1.
    float power = 0;
    bool two_sided = false;

    /// Radiance of a shape of this area.
    Rgb radiance_of(float area) const;
};
AreaLight load_area_light(LoadContext& context, TextureLoader& textures, const pbrt::Entity& light);

/// Makes a surface shine: appends a light for each of its primitives and lets the surface refer to them. Triangles
/// without area stay dark.
void attach(const AreaLight& light, const Transform& world_from_object, Surface& surface, std::vector<Light>& lights);

}  // namespace wend
