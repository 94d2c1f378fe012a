// Points spread over some of a scene's surfaces.
#pragma once

#include <wend/sampling/discrete.h>
#include <wend/scene/scene.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace wend {

/// Draws points of chosen surfaces, placed objects included, evenly by the area at time 0; on stretched spheres and
/// disks not quite evenly, and on curves and cylinders (which neither shine nor bound media) none. The scene must
/// outlive it.
class SurfaceSampler {
public:
    SurfaceSampler(const SceneDescription& scene, const std::function<bool(const Surface&)>& is_chosen);

    /// Whether no such surface has an area.
    bool is_empty() const { return elements_.empty(); }
    /// Of all of them, in the world.
    float area() const { return area_; }

    struct Point {
        const Surface* surface;
        Vec3 position;
        Vec3 normal;  ///< unit length, towards the exterior
    };
    /// From uniform numbers, as the surfaces are at a time (Ray::time); not while it is empty. Not finite where the
    /// surface is not.
    Point sample(float u, const Vec2& u2, float time = 0) const;

private:
    /// A triangle, sphere or disk.
    struct Element {
        const Surface* surface;
        std::uint32_t primitive;
        std::uint32_t placement;
    };

    /// In the last placement.
    void add_surface(const Surface& surface);
    void add_element(const Surface& surface, std::size_t primitive, float area);

    std::vector<Placement> placements_;   ///< at time 0
    std::vector<const Motion*> motions_;  ///< by placement; null where it is at rest
    std::vector<Element> elements_;
    std::vector<float> areas_;
    float area_ = 0;
    AliasTable table_;
};

}  // namespace wend
