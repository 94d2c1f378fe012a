#pragma once

#include <wend/core/vector.h>
#include <wend/scene/acceleration.h>
#include <wend/scene/embree.h>
#include <wend/scene/scene.h>

#include <memory>
#include <optional>
#include <vector>

namespace wend {

/// Embree over the surfaces of a scene. Its instruction set is pinned, so that the same rays hit the same points on
/// every machine.
class RayCaster {
public:
    /// Refers to the description, which must not move nor change. Shares the structure of another one where it is that
    /// of this description as well.
    explicit RayCaster(const SceneDescription& description, const RayCaster* other = nullptr);

    bool shares_structure_with(const RayCaster& other) const { return structure_ == other.structure_; }

    /// Neither meets `target`.
    std::optional<RayHit> intersect(const TracedRay& ray, float distance, Visible visible,
                                    const SurfaceElement& target = {}) const;
    bool is_occluded(const TracedRay& ray, float distance, const SurfaceElement& target = {}) const;

    /// The hit's place, normals and parameters in the world.
    Hit complete(const RayHit& raw, const Ray& ray) const;
    /// Of the shading normal (Scene::normal_change).
    Vec3 normal_change(const Hit& hit, const Vec3& displacement) const;
    /// How place and shading normal change with the surface parameters.
    SurfaceDerivatives derivatives(const Hit& hit) const;
    Box3 bounds() const;

private:
    /// A query's ray, for the callbacks.
    struct Query;
    static void filter(const RTCFilterFunctionNArguments* arguments);
    static void intersect_own_shape(const RTCIntersectFunctionNArguments* arguments);
    static void occlude_own_shape(const RTCOccludedFunctionNArguments* arguments);

    /// A ray from further than Embree reckons, or of what is not a number, leaves the scene: it hits nothing.
    bool reaches_scene(const TracedRay& ray, float distance) const;
    /// The scene's index of Embree's instance.
    int instance(unsigned id) const;
    /// Where an instance stands at a time; null for -1. `moved` is room for it.
    const Placement* placement_of(int instance, float time, std::optional<Placement>& moved) const {
        if (instance < 0) {
            return nullptr;
        }
        const auto i = static_cast<std::size_t>(instance);
        if (is_moving_ && d_.instances[i].world_from_object.is_moving()) {
            return &moved.emplace(d_.instances[i].world_from_object.at(time));
        }
        return &placements_[i];
    }

    const SceneDescription& d_;
    std::shared_ptr<const AccelerationStructure> structure_;
    std::vector<Placement> placements_;  ///< of instances, at time 0
    bool is_moving_ = false;
    std::vector<bool> has_direction_;  ///< by material: whether it matters where along the surface tangents are
};

}  // namespace wend
