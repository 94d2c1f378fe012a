// Shapes that shine: what is asked of them, and the lights that they become.
#pragma once

#include <wend/scene/light.h>
#include <wend/scene/scene.h>

#include <cstddef>
#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace wend {

/// What an AreaLightSource directive asks of the shapes that follow it.
struct AreaLight {
    Rgb radiance;
    /// Multiplies the radiance; null: 1.
    std::shared_ptr<const LightPicture> picture;
    /// Where positive, the power that each of pbrt's shapes (of a mesh, each triangle) emits if `radiance` has
    /// luminance 1, and whatever the picture's is.
    float power = 0;
    bool two_sided = false;
    /// Whether it is in the way of others; if not, its shape is of an interface.
    bool is_solid = true;
    /// Whether the opacity of its shape counts once for rays that nothing was connected for, and not twice as in pbrt.
    bool is_once = false;
    /// Multiplies the radiance, by direction; the axis is that of the shape's own space. None: 1.
    std::optional<EmissionProfile> profile;

    /// Radiance of a shape of this area, where the picture is 1.
    Rgb radiance_of(float area) const;
};

/// Where a surface shines, and how.
struct LampPlace {
    Presence presence = Presence::solid;
    /// How many shapes the surface's triangles are to pbrt, each with the power of one; 0: as many as triangles.
    std::size_t shapes = 0;
    Transform world_from_object;           ///< of the shape, as its directive stands
    std::shared_ptr<const Motion> motion;  ///< of the surface in its world; null: it stands still
};

/// Makes a surface shine: appends a light for each of its primitives and lets the surface refer to them. Triangles
/// without area stay dark.
void attach(const AreaLight& light, const LampPlace& at, Surface& surface, std::vector<Light>& lights);

/// In what a lamp on a sphere, disk or cylinder differs from pbrt's, which draws points of it as if it were whole and
/// of the size in its own space; empty where it is.
std::string_view round_lamp_difference(std::string_view shape_type, const Shape& shape,
                                       const Transform& world_from_object);

}  // namespace wend
