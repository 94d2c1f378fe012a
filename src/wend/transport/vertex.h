// Where a walk scatters.
#pragma once

#include <wend/scene/light_sampler.h>
#include <wend/scene/scene.h>

namespace wend {

/// A vertex of a walk: a collision in a medium or a point of a surface. It is made once and handed on; the hit of a
/// surface must outlive it.
struct Vertex {
    Vec3 position;
    Vec3 normal{0, 0, 0};      ///< of the surface, geometric, whichever side the walk comes from; zero in a medium
    Vec3 facing{0, 0, 0};      ///< the same on the side that the walk comes from
    const Hit* hit = nullptr;  ///< of the surface; null in a medium
    /// How often it is connected to lights from the collision before, as a mean: InteriorTechnique connects the
    /// boundary ahead.
    float connected_before = 0;

    static Vertex in_medium(const Vec3& position) { return {position}; }
    static Vertex on_surface(const Hit& hit, const Vec3& arriving) {
        return {hit.position, hit.normal, facing_normal(hit, arriving), &hit};
    }
    /// The normal on the side that a ray with this direction comes from.
    static Vec3 facing_normal(const Hit& hit, const Vec3& arriving) {
        return dot(hit.normal, arriving) < 0 ? hit.normal : -hit.normal;
    }

    bool in_volume() const { return !hit; }
    /// For lights, as the surface stands.
    LightReceiver receiver() const { return {position, normal}; }
    /// For what is learned by place and side.
    LightReceiver side() const { return {position, facing}; }
};

}  // namespace wend
