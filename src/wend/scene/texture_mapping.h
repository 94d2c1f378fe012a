// Where on a picture or pattern a surface point is.
#pragma once

#include <wend/core/transform.h>
#include <wend/core/vector.h>

#include <cstdint>
#include <variant>

namespace wend {

/// What a texture is evaluated at.
struct TexturePoint {
    Vec2 uv;
    Vec3 position;               ///< in the world
    Vec3 normal{0, 0, 0};        ///< geometric, of unit length; of no matter to most textures
    bool is_behind = false;      ///< whether it is seen from where the normal does not point to
    std::uint32_t triangle = 0;  ///< of a mesh, and how much of the value is that of its second and third corner
    Vec2 of_corners{0, 0};
    float facing = 1;  ///< magnitude of the cosine between the interpolated normal and where it is seen from
};

/// By the surface's own parameters, an affine map of them.
struct UvMapping {
    float su = 1, sv = 1, du = 0, dv = 0;
    float sv_of_s = 0;  ///< what v adds to s
    float su_of_t = 0;  ///< what u adds to t

    Vec2 operator()(const TexturePoint& p) const {
        return {su * p.uv.x + sv_of_s * p.uv.y + du, su_of_t * p.uv.x + sv * p.uv.y + dv};
    }
};

/// By the angles from the z axis and about it in texture space, as parts of 180 and 360 degrees.
struct SphericalMapping {
    AffineMap texture_from_world;

    Vec2 operator()(const TexturePoint& p) const;
};

/// By the angle about the z axis in texture space, as a part of 360 degrees from -x on, and z.
struct CylindricalMapping {
    AffineMap texture_from_world;

    Vec2 operator()(const TexturePoint& p) const;
};

/// By the products with two vectors in texture space.
struct PlanarMapping {
    AffineMap texture_from_world;
    Vec3 vs{1, 0, 0}, vt{0, 1, 0};
    float ds = 0, dt = 0;

    Vec2 operator()(const TexturePoint& p) const;
};

using TextureMapping = std::variant<UvMapping, SphericalMapping, CylindricalMapping, PlanarMapping>;

/// Texture coordinates (s, t) of a point.
Vec2 map_to_texture(const TextureMapping& mapping, const TexturePoint& p);

}  // namespace wend
