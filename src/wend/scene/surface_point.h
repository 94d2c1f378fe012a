// What is known of a point of a surface: place, normals, parameters, and how these change along the surface.
#pragma once

#include <wend/core/motion.h>
#include <wend/scene/scene.h>

namespace wend {

/// What a surface's material wants to know of a hit beyond place and normals.
struct AskedOfHit {
    bool uv;       ///< the parameters of quadrics and cylinders
    bool tangent;  ///< that of meshes without texture coordinates; otherwise the shading frame is any
};

/// What a ray has met on a surface, in the world. `placement`: where the surface's object stands at the time of the
/// ray; null for what is no instance.
Hit completed(const RayHit& raw, const Ray& ray, const Surface& surface, const Placement* placement,
              const AskedOfHit& asked);

/// Of the shading normal (Scene::normal_change).
Vec3 normal_change(const Hit& hit, const Placement* placement, const Vec3& displacement);

/// How place and shading normal change with the surface parameters.
SurfaceDerivatives surface_derivatives(const Hit& hit, const Placement* placement);

}  // namespace wend
