// Shading normals that a surface's material gives it beyond its shape: bumps and normal maps.
#pragma once

#include <wend/core/image.h>
#include <wend/core/vector.h>
#include <wend/scene/texture.h>

#include <memory>

namespace wend {

/// Where the surface seems to be, or what normals it has. At most one of them is given.
struct SurfaceDetail {
    TextureId displacement = -1;              ///< along the normal, in the world's unit; -1: none
    std::shared_ptr<const Image> normal_map;  ///< x, y, z as 0 to 1 for -1 to 1, against the shading frame; may be null

    bool is_none() const { return displacement < 0 && !normal_map; }
};

/// How place and normal change with the surface parameters, in the world.
struct SurfaceDerivatives {
    Vec3 dpdu, dpdv;
    Vec3 dndu, dndv;  ///< of the unit shading normal
};

/// The frame that a detail makes of a shading frame at a point; its z stays on the side of `normal`.
Frame detailed_frame(const SurfaceDetail& detail, const Frame& shading, const Vec3& normal, const TexturePoint& p,
                     const SurfaceDerivatives& surface, const Textures& textures);

}  // namespace wend
