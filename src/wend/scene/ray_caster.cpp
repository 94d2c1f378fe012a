#include <wend/core/error.h>
#include <wend/scene/ray_caster.h>
#include <wend/scene/surface_point.h>

#include <algorithm>
#include <cstring>
#include <new>

namespace wend {
namespace {

/// Of one of the shapes whose crossings are ours to find: all but meshes.
void bound_own_shape(const RTCBoundsFunctionArguments* arguments) {
    const auto& surface = *static_cast<const Surface*>(arguments->geometryUserPtr);
    const auto* curves = std::get_if<CurveSet>(&surface.shape);
    const Box3 box = curves ? bounds(*curves, arguments->primID) : bounds(surface.shape);
    // A flat disk's box must not be empty, nor rounding cut into a sphere.
    const Vec3 margin = box.size() * 1e-5f + Vec3(1e-6f);
    *arguments->bounds_o = {box.min.x - margin.x, box.min.y - margin.y, box.min.z - margin.z, 0,
                            box.max.x + margin.x, box.max.y + margin.y, box.max.z + margin.z, 0};
}

/// Embree refuses, by an assertion, origins and directions beyond 1.844e18 and what is not a number, also in the spaces
/// of instances. The rest of the range is for rounding.
constexpr float embree_reach = 1e18f;

/// The largest coordinate that a map makes of coordinates up to 1.
float largest_image(const Transform& map) {
    double largest = 1;
    for (int row = 0; row < 3; ++row) {
        double sum = 0;
        for (int column = 0; column < 4; ++column) {
            sum += std::abs(map.element(row, column));
        }
        largest = std::max(largest, sum);
    }
    return static_cast<float>(largest);
}

RTCRay to_embree(const TracedRay& ray, float distance, unsigned mask) {
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
    r.mask = mask;
    r.time = ray.time;
    return r;
}

template <class T>
T* new_buffer(RTCGeometry geometry, RTCBufferType type, unsigned slot, RTCFormat format, std::size_t count) {
    void* data = rtcSetNewGeometryBuffer(geometry, type, slot, format, sizeof(T), count);
    if (!data) {
        throw std::bad_alloc();
    }
    return static_cast<T*>(data);
}

/// Of a mesh at a step of time.
void copy_vertices(RTCGeometry geometry, unsigned step, const std::vector<Vec3>& positions) {
    auto* vertices = new_buffer<Vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, step, RTC_FORMAT_FLOAT3, positions.size());
    std::copy(positions.begin(), positions.end(), vertices);
}

struct Triangle {
    std::uint32_t corners[3];
};

}  // namespace

struct RayCaster::Query : EmbreeContext {
    Query(const RayCaster& of, const TracedRay& traced) : caster(of), ray(traced) { embree_start(*this); }

    bool is_ahead(unsigned surface, unsigned primitive, unsigned inst, float t, bool along) const {
        return ray.is_ahead({surface, primitive, caster.instance(inst)}, t, along);
    }
    /// Where the ray meets a shape of ours next within its bounds; u and v are those of curves.
    std::optional<CurveCrossing> next(unsigned surface, unsigned primitive, const RTCRay& bounds) const {
        const Shape& shape = caster.d_.surfaces[surface].shape;
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
        Vec3 offset = ray.offset_for({surface, primitive, inst});
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

RayCaster::RayCaster(const SceneDescription& description)
    : d_(description), device_(rtcNewDevice("isa=avx2")), reach_(embree_reach) {
    if (!device_) {
        device_.reset(rtcNewDevice("isa=sse4.2"));
    }
    if (!device_) {
        throw std::runtime_error("Embree cannot start on this processor (it needs SSE 4.2)");
    }
    const auto new_scene = [&](const std::vector<int>& surfaces) {
        SceneHandle scene(rtcNewScene(device_.get()));
        rtcSetSceneBuildQuality(scene.get(), RTC_BUILD_QUALITY_HIGH);
        rtcSetSceneFlags(scene.get(), RTC_SCENE_FLAG_ROBUST);
        for (const int surface : surfaces) {
            attach(scene.get(), surface);
        }
        return scene;
    };
    for (const ObjectDefinition& object : d_.objects) {
        objects_.push_back(new_scene(object.surfaces));
        rtcCommitScene(objects_.back().get());
    }
    scene_ = new_scene(d_.world_surfaces);
    for (const Instance& instance : d_.instances) {
        add_instance(instance);
    }
    rtcCommitScene(scene_.get());
    if (rtcGetDeviceError(device_.get()) != RTC_ERROR_NONE) {
        throw std::runtime_error("Embree could not build the acceleration structure");
    }
}

void RayCaster::add_instance(const Instance& instance) {
    const Motion& motion = instance.world_from_object;
    RTCGeometry geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_INSTANCE);
    rtcSetGeometryInstancedScene(geometry, objects_[static_cast<std::size_t>(instance.object)].get());
    rtcSetGeometryTimeStepCount(geometry, static_cast<unsigned>(motion.key_count()));
    for (std::size_t i = 0; i < motion.key_count(); ++i) {
        const Transform& world_from_object = motion.key(i);
        float matrix[12];
        for (int column = 0; column < 4; ++column) {
            for (int row = 0; row < 3; ++row) {
                matrix[column * 3 + row] = static_cast<float>(world_from_object.element(row, column));
            }
        }
        rtcSetGeometryTransform(geometry, static_cast<unsigned>(i), RTC_FORMAT_FLOAT3X4_COLUMN_MAJOR, matrix);
        reach_ = std::min(reach_, embree_reach / largest_image(world_from_object.inverse()));
    }
    rtcSetGeometryMask(geometry, everything);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene_.get(), geometry, static_cast<unsigned>(d_.surfaces.size() + placements_.size()));
    rtcReleaseGeometry(geometry);
    placements_.push_back(motion.at(0));
    is_moving_ = is_moving_ || motion.is_moving();
}

void RayCaster::attach(RTCScene scene, int index) {
    const Surface& surface = d_.surfaces[static_cast<std::size_t>(index)];
    RTCGeometry geometry = nullptr;
    if (const auto* mesh = std::get_if<TriangleMesh>(&surface.shape)) {
        geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_TRIANGLE);
        rtcSetGeometryTimeStepCount(geometry, mesh->is_moving() ? 2 : 1);
        copy_vertices(geometry, 0, mesh->positions);
        if (mesh->is_moving()) {
            copy_vertices(geometry, 1, mesh->end_positions);
        }
        auto* indices =
            new_buffer<Triangle>(geometry, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, mesh->triangle_count());
        std::memcpy(indices, mesh->indices.data(), mesh->triangle_count() * sizeof(Triangle));
        rtcSetGeometryIntersectFilterFunction(geometry, filter);
        rtcSetGeometryOccludedFilterFunction(geometry, filter);
    } else {
        geometry = rtcNewGeometry(device_.get(), RTC_GEOMETRY_TYPE_USER);
        const auto* curves = std::get_if<CurveSet>(&surface.shape);
        rtcSetGeometryUserPrimitiveCount(geometry, curves ? static_cast<unsigned>(curves->primitive_count()) : 1);
        rtcSetGeometryUserData(geometry, const_cast<Surface*>(&surface));
        rtcSetGeometryBoundsFunction(geometry, bound_own_shape, nullptr);
        rtcSetGeometryIntersectFunction(geometry, intersect_own_shape);
        rtcSetGeometryOccludedFunction(geometry, occlude_own_shape);
    }
    const Material& material = d_.materials[static_cast<std::size_t>(surface.material)];
    const bool can_pass = std::holds_alternative<InterfaceMaterial>(material) || surface.alpha >= 0;
    rtcSetGeometryMask(geometry, can_pass ? interfaces : opaque);
    rtcCommitGeometry(geometry);
    rtcAttachGeometryByID(scene, geometry, static_cast<unsigned>(index));
    rtcReleaseGeometry(geometry);
}

int RayCaster::instance(unsigned id) const {
    return id == RTC_INVALID_GEOMETRY_ID ? -1 : static_cast<int>(id - static_cast<unsigned>(d_.surfaces.size()));
}

bool RayCaster::reaches_scene(const TracedRay& ray, float distance) const {
    const auto is_near = [this](const Vec3& v) {
        return std::abs(v.x) <= reach_ && std::abs(v.y) <= reach_ && std::abs(v.z) <= reach_;
    };
    return is_near(ray.start()) && is_near(ray.direction) && distance >= 0;
}

std::optional<RayHit> RayCaster::intersect(const TracedRay& ray, float distance, Visible visible) const {
    if (!reaches_scene(ray, distance)) {
        return std::nullopt;
    }
    RTCRayHit found;
    found.ray = to_embree(ray, distance, visible);
    found.hit.geomID = RTC_INVALID_GEOMETRY_ID;
    found.hit.instID[0] = RTC_INVALID_GEOMETRY_ID;
    Query query(*this, ray);
    embree_intersect(scene_.get(), query, found);
    if (found.hit.geomID == RTC_INVALID_GEOMETRY_ID) {
        return std::nullopt;
    }
    return RayHit{found.ray.tfar - ray.passed(),
                  found.ray.tfar,
                  found.hit.u,
                  found.hit.v,
                  {found.hit.geomID, found.hit.primID, instance(found.hit.instID[0])}};
}

bool RayCaster::is_occluded(const TracedRay& ray, float distance) const {
    if (!reaches_scene(ray, distance)) {
        return false;
    }
    RTCRay found = to_embree(ray, distance, opaque);
    Query query(*this, ray);
    embree_occluded(scene_.get(), query, found);
    return found.tfar < 0;
}

Hit RayCaster::complete(const RayHit& raw, const Ray& ray) const {
    const Surface& surface = d_.surfaces[raw.element.surface];
    const Material& material = d_.materials[static_cast<std::size_t>(surface.material)];
    const bool has_uv = !std::holds_alternative<InterfaceMaterial>(material) || surface.alpha >= 0;
    std::optional<Placement> moved;
    return completed(raw, ray, surface, placement_of(raw.element.instance, ray.time, moved), has_uv);
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
    rtcGetSceneBounds(scene_.get(), &b);
    return {Vec3(b.lower_x, b.lower_y, b.lower_z), Vec3(b.upper_x, b.upper_y, b.upper_z)};
}

}  // namespace wend
