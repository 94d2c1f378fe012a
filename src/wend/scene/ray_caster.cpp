#include <wend/scene/ray_caster.h>

#include <wend/core/error.h>
#include <wend/scene/surface_point.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace wend {
namespace {

RTCRay to_embree(const TracedRay& ray, float distance, Visible visible) {
    RTCRay r{};
    r.org_x = ray.start().x;
    r.org_y = ray.start().y;
    r.org_z = ray.start().z;
    r.dir_x = ray.direction.x;
    r.dir_y = ray.direction.y;
    r.dir_z = ray.direction.z;
    // What lies at the same distance as the last crossing is still to be met.
    r.tnear = ray.passed() > 0 ? std::nextafter(ray.passed(), 0.0f) : 0.0f;
    r.tfar = ray.passed() + distance;
    r.mask = static_cast<unsigned>(visible);
    r.time = ray.time;
    return r;
}

}  // namespace

struct RayCaster::Query : EmbreeContext {
    Query(const RayCaster& of, const TracedRay& traced, const SurfaceElement& aimed_at)
        : caster(of), ray(traced), target(aimed_at) {
        embree_start(*this);
    }

    bool is_ahead(unsigned surface, unsigned primitive, unsigned inst, float t, bool along) const {
        const SurfaceElement met{surface, primitive, caster.instance(inst)};
        return met != target && ray.is_ahead(met, t, along);
    }
    /// Where the ray meets a shape of ours next within its bounds; u and v are those of curves.
    std::optional<CurveCrossing> next(unsigned surface, unsigned primitive, const RTCRay& bounds) const {
        const Shape& shape = *caster.d_.surfaces[surface].shape;
        if (const auto* quadric = std::get_if<Quadric>(&shape)) {
            return next_of(*quadric, surface, bounds);
        }
        if (const auto* cylinder = std::get_if<CylinderShell>(&shape)) {
            return next_of(*cylinder, surface, bounds);
        }
        return next_of(std::get<CurveSet>(shape), surface, primitive, bounds);
    }
    /// Of a quadric or cylinder.
    template <class Solid>
    std::optional<CurveCrossing> next_of(const Solid& solid, unsigned surface, const RTCRay& bounds) const {
        const Vec3 origin = solid.object_from_world.point({bounds.org_x, bounds.org_y, bounds.org_z});
        const Vec3 direction = solid.object_from_world.vector({bounds.dir_x, bounds.dir_y, bounds.dir_z});
        for (const auto& crossing : crossings(solid, origin, direction)) {
            if (crossing.t > bounds.tnear && crossing.t < bounds.tfar &&
                is_ahead(surface, 0, instID[0], crossing.t, crossing.along)) {
                return CurveCrossing{crossing.t, 0, 0};
            }
        }
        return std::nullopt;
    }
    std::optional<CurveCrossing> next_of(const CurveSet& curves, unsigned surface, unsigned primitive,
                                         const RTCRay& bounds) const {
        const int inst = caster.instance(instID[0]);
        Vec3 offset = ray.offset_for({surface, primitive, inst}, curves.pieces);
        std::optional<Placement> moved;
        if (const Placement* placement = caster.placement_of(inst, ray.time, moved)) {
            offset = placement->object_from_world.vector(offset);
        }
        const Vec3 start(bounds.org_x, bounds.org_y, bounds.org_z), way(bounds.dir_x, bounds.dir_y, bounds.dir_z);
        // What Embree asks for has the ray itself in its bounds: so has what is found, or the answer would depend on
        // how far it looks.
        const bool is_shifted = length_squared(offset) > 0;
        const Box3 box = is_shifted ? wend::bounds(curves, primitive) : Box3();
        const auto accept = [&](float t) {
            return is_ahead(surface, primitive, instID[0], t, true) && (!is_shifted || box.intersects(start + way * t));
        };
        return next_crossing(curves, primitive, start + offset, way, bounds.tnear, bounds.tfar, CrossingFilter(accept));
    }

    const RayCaster& caster;
    const TracedRay& ray;
    const SurfaceElement& target;
};

void RayCaster::filter(const RTCFilterFunctionNArguments* arguments) {
    if (!arguments->valid[0]) {
        return;
    }
    const auto& query = *static_cast<const Query*>(arguments->context);
    const auto& ray = *reinterpret_cast<const RTCRay*>(arguments->ray);
    const auto& hit = *reinterpret_cast<const RTCHit*>(arguments->hit);
    const bool along = hit.Ng_x * ray.dir_x + hit.Ng_y * ray.dir_y + hit.Ng_z * ray.dir_z > 0;
    if (!query.is_ahead(hit.geomID, hit.primID, hit.instID[0], ray.tfar, along)) {
        arguments->valid[0] = 0;
    }
}

void RayCaster::intersect_own_shape(const RTCIntersectFunctionNArguments* arguments) {
    if (!arguments->valid[0]) {
        return;
    }
    const auto& query = *static_cast<const Query*>(arguments->context);
    auto* rayhit = reinterpret_cast<RTCRayHit*>(arguments->rayhit);
    if (const auto hit = query.next(arguments->geomID, arguments->primID, rayhit->ray)) {
        rayhit->ray.tfar = hit->t;
        rayhit->hit.u = hit->u;
        rayhit->hit.v = hit->v;
        rayhit->hit.geomID = arguments->geomID;
        rayhit->hit.primID = arguments->primID;
        rayhit->hit.instID[0] = query.instID[0];
    }
}

void RayCaster::occlude_own_shape(const RTCOccludedFunctionNArguments* arguments) {
    if (!arguments->valid[0]) {
        return;
    }
    const auto& query = *static_cast<const Query*>(arguments->context);
    auto* ray = reinterpret_cast<RTCRay*>(arguments->ray);
    if (query.next(arguments->geomID, arguments->primID, *ray)) {
        ray->tfar = -infinity;
    }
}

RayCaster::RayCaster(const SceneDescription& description, const RayCaster* other) : d_(description) {
    placements_.reserve(d_.instances.size());
    for (const Instance& instance : d_.instances) {
        placements_.push_back(instance.world_from_object.at(0));
        is_moving_ = is_moving_ || instance.world_from_object.is_moving();
    }
    for (std::size_t i = 0; i < d_.materials.size(); ++i) {
        has_direction_.push_back(is_directed(d_.materials[i]) || (i < d_.details.size() && d_.details[i].normal_map));
    }
    SeenShapes shapes(d_);
    structure_ =
        other && other->structure_->is_of(shapes)
            ? other->structure_
            : std::make_shared<const AccelerationStructure>(
                  std::move(shapes), AccelerationStructure::Callbacks{filter, intersect_own_shape, occlude_own_shape});
}

int RayCaster::instance(unsigned id) const {
    return id == RTC_INVALID_GEOMETRY_ID ? -1 : static_cast<int>(id - static_cast<unsigned>(d_.surfaces.size()));
}

bool RayCaster::reaches_scene(const TracedRay& ray, float distance) const {
    const auto is_near = [reach = structure_->reach()](const Vec3& v) {
        return std::abs(v.x) <= reach && std::abs(v.y) <= reach && std::abs(v.z) <= reach;
    };
    return is_near(ray.start()) && is_near(ray.direction) && distance >= 0;
}

std::optional<RayHit> RayCaster::intersect(const TracedRay& ray, float distance, Visible visible,
                                           const SurfaceElement& target) const {
    if (!reaches_scene(ray, distance)) {
        return std::nullopt;
    }
    RTCRayHit found;
    found.ray = to_embree(ray, distance, visible);
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Query query(*this, ray, target);
    embree_intersect(structure_->scene(), query, found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return RayHit{found.ray.tfar - ray.passed(),
                  found.ray.tfar,
                  found.hit.u,
                  found.hit.v,
                  {found.hit.geomID, found.hit.primID, instance(found.hit.instID[0])}};
}

bool RayCaster::is_occluded(const TracedRay& ray, float distance, const SurfaceElement& target) const {
    if (!reaches_scene(ray, distance)) {
        return false;
    }
    RTCRay found = to_embree(ray, distance, Visible::opaque);
    Query query(*this, ray, target);
    embree_occluded(structure_->scene(), query, found);
    return found.tfar < 0;
}

Hit RayCaster::complete(const RayHit& raw, const Ray& ray) const {
    const Surface& surface = d_.surfaces[raw.element.surface];
    const Material& material = d_.materials[static_cast<std::size_t>(surface.material)];
    const bool has_uv = !std::holds_alternative<InterfaceMaterial>(material) || surface.alpha >= 0;
    std::optional<Placement> moved;
    return completed(raw, ray, surface, placement_of(raw.element.instance, ray.time, moved),
                     {has_uv, has_direction_[static_cast<std::size_t>(surface.material)]});
}

Vec3 RayCaster::normal_change(const Hit& hit, const Vec3& displacement) const {
    std::optional<Placement> moved;
    return wend::normal_change(hit, placement_of(hit.element.instance, hit.time, moved), displacement);
}

SurfaceDerivatives RayCaster::derivatives(const Hit& hit) const {
    std::optional<Placement> moved;
    return surface_derivatives(hit, placement_of(hit.element.instance, hit.time, moved));
}

Box3 RayCaster::bounds() const {
    RTCBounds b;
    rtcGetSceneBounds(structure_->scene(), &b);
    return {Vec3(b.lower_x, b.lower_y, b.lower_z), Vec3(b.upper_x, b.upper_y, b.upper_z)};
}

}  // namespace wend
