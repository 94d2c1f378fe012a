#include <wend/core/error.h>
#include <wend/scene/ray_caster.h>

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
T* new_buffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::size_t count) {
    void* data = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), count);
    if (!data) {
        throw std::bad_alloc();
    }
    return static_cast<T*>(data);
}

/// What a position and Embree's distance to it may be off by, over the coordinates that they are made of: some of the
/// spacings of floats, with room to spare (pharr2023, section 6.8).
constexpr float rounding = 1e-6f;

/// Magnitudes, by coordinate.
Vec3 largest_of(const Vec3& a, const Vec3& b) {
    return {std::max(std::abs(a.x), std::abs(b.x)), std::max(std::abs(a.y), std::abs(b.y)),
            std::max(std::abs(a.z), std::abs(b.z))};
}

float max_of(const Vec3& v) {
    return std::max({v.x, v.y, v.z});
}

struct Triangle {
    std::uint32_t corners[3];
};

struct Tangents {
    Vec3 dpdu{0, 0, 0};
    bool valid = false;
};

/// dp/du of a triangle from its texture coordinates.
Tangents tangents(const Vec3& e1, const Vec3& e2, const Vec2& d1, const Vec2& d2) {
    const float determinant = d1.x * d2.y - d1.y * d2.x;
    if (std::abs(determinant) < 1e-12f) {
        return {};
    }
    return {(e1 * d2.y - e2 * d1.y) / determinant, true};
}

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
        auto* vertices = new_buffer<Vec3>(geometry, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, mesh->positions.size());
        std::copy(mesh->positions.begin(), mesh->positions.end(), vertices);
        auto* indices = new_buffer<Triangle>(geometry, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, mesh->triangle_count());
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

namespace {

/// A point of a surface in the space of its object.
struct LocalPoint {
    Vec3 position, normal, shading;
    Vec3 largest;  ///< of the coordinates that the position is made of
    Tangents tangents{};
};

/// Fills in what of a hit on a mesh needs no placement.
LocalPoint point_of(const TriangleMesh& mesh, const RayHit& raw, Hit& hit) {
    const std::uint32_t* i = &mesh.indices[3 * std::size_t{raw.element.primitive}];
    const Vec3 &p0 = mesh.positions[i[0]], &p1 = mesh.positions[i[1]], &p2 = mesh.positions[i[2]];
    const Vec3 e1 = p1 - p0;
    const Vec3 e2 = p2 - p0;
    const float w = 1 - raw.u - raw.v;
    LocalPoint point;
    point.largest = largest_of(largest_of(p0, p1), p2);
    point.position = p0 + e1 * raw.u + e2 * raw.v;
    point.normal = cross(e1, e2);
    if (mesh.uvs.empty()) {
        hit.uv = {raw.u + raw.v, raw.v};  // pbrt's default: (0,0), (1,0), (1,1)
    } else {
        const Vec2 uv0 = mesh.uvs[i[0]], uv1 = mesh.uvs[i[1]], uv2 = mesh.uvs[i[2]];
        hit.uv = uv0 * w + uv1 * raw.u + uv2 * raw.v;
        point.tangents = tangents(e1, e2, uv1 - uv0, uv2 - uv0);
    }
    if (mesh.normals.empty()) {
        hit.against_winding = hit.surface->flip_normal;
        point.normal = hit.against_winding ? -point.normal : point.normal;
        point.shading = point.normal;
    } else {
        point.shading = mesh.normals[i[0]] * w + mesh.normals[i[1]] * raw.u + mesh.normals[i[2]] * raw.v;
        hit.against_winding = dot(point.normal, point.shading) < 0;
        point.normal = hit.against_winding ? -point.normal : point.normal;
        point.shading = length_squared(point.shading) > 0 ? point.shading : point.normal;
    }
    return point;
}

/// The same of a quadric or cylinder, near the point p. `has_uv`: whether anybody asks for its parameters.
template <class Solid>
LocalPoint point_of(const Solid& quadric, const Vec3& p, bool has_uv, Hit& hit) {
    const QuadricPoint on_it = project(quadric, quadric.object_from_world.point(p));
    LocalPoint point;
    point.position = quadric.world_from_object.point(on_it.position);
    point.largest = quadric.world_from_object.magnitude(Vec3(extent(quadric)));
    point.normal = quadric.object_from_world.transposed_vector(on_it.normal);
    hit.against_winding = hit.surface->flip_normal;
    point.normal = hit.against_winding ? -point.normal : point.normal;
    point.shading = point.normal;
    if (has_uv) {
        hit.uv = parameters(quadric, on_it.position);
    }
    point.tangents = {quadric.world_from_object.vector(on_it.dpdu), length_squared(on_it.dpdu) > 0};
    return point;
}

/// The same of a curve, at the point p of a ray of this direction.
LocalPoint point_of(const CurveSet& curves, const RayHit& raw, const Vec3& p, const Vec3& direction, Hit& hit) {
    const CurvePoint on_it = curve_point(curves, raw.element.primitive, raw.u, raw.v, direction);
    LocalPoint point;
    point.position = p;
    point.largest = largest_of(p, p);
    hit.against_winding = hit.surface->flip_normal;
    point.normal = normalize(hit.against_winding ? -on_it.normal : on_it.normal);
    point.shading = point.normal;
    point.tangents = {on_it.dpdu, length_squared(on_it.dpdu) > 0};
    hit.uv = {raw.u, raw.v};
    // As pbrt has it, which takes the width for the error of each coordinate.
    hit.thickness = on_it.width * (std::abs(point.normal.x) + std::abs(point.normal.y) + std::abs(point.normal.z));
    return point;
}

/// Along dp/du where that is known.
Frame shading_frame(const Vec3& shading, const Tangents& t) {
    const Vec3 n = normalize(shading);
    const Vec3 along = t.dpdu - n * dot(n, t.dpdu);
    if (!t.valid || !(length_squared(along) > 1e-14f * length_squared(t.dpdu))) {
        return Frame::from_z(n);
    }
    Frame frame;
    frame.s = normalize(along);
    frame.t = cross(n, frame.s);
    frame.n = n;
    return frame;
}

}  // namespace

Hit RayCaster::complete(const RayHit& raw, const Ray& ray) const {
    Hit hit;
    hit.distance = raw.distance;
    hit.t = raw.t;
    hit.time = ray.time;
    hit.surface = &d_.surfaces[raw.element.surface];
    hit.element = raw.element;
    hit.light = hit.surface->first_light < 0 ? -1 : hit.surface->first_light + static_cast<int>(raw.element.primitive);
    std::optional<Placement> moved_to;
    const Placement* const placement = placement_of(raw.element.instance, ray.time, moved_to);
    LocalPoint point;
    if (const auto* mesh = std::get_if<TriangleMesh>(&hit.surface->shape)) {
        point = point_of(*mesh, raw, hit);
    } else {
        const Vec3 in_world = ray.at(raw.distance);
        const Vec3 p = placement ? placement->object_from_world.point(in_world) : in_world;
        const Material& material = d_.materials[static_cast<std::size_t>(hit.surface->material)];
        const bool has_uv = !std::holds_alternative<InterfaceMaterial>(material) || hit.surface->alpha >= 0;
        if (const auto* quadric = std::get_if<Quadric>(&hit.surface->shape)) {
            point = point_of(*quadric, p, has_uv, hit);
        } else if (const auto* cylinder = std::get_if<CylinderShell>(&hit.surface->shape)) {
            point = point_of(*cylinder, p, has_uv, hit);
        } else {
            const Vec3 way = placement ? placement->object_from_world.vector(ray.direction) : ray.direction;
            point = point_of(std::get<CurveSet>(hit.surface->shape), raw, p, way, hit);
        }
    }
    if (placement) {
        point.position = placement->world_from_object.point(point.position);
        point.normal = placement->object_from_world.transposed_vector(point.normal);
        point.shading = placement->object_from_world.transposed_vector(point.shading);
        point.tangents.dpdu = placement->world_from_object.vector(point.tangents.dpdu);
        point.largest = placement->world_from_object.magnitude(point.largest);
    }
    hit.position = point.position;
    hit.normal = normalize(point.normal);
    hit.is_behind = dot(ray.direction, hit.normal) > 0;
    // Along the normal: a wide surface across an axis is as exact as its place on that axis.
    const Vec3 facing(std::abs(hit.normal.x), std::abs(hit.normal.y), std::abs(hit.normal.z));
    hit.clearance = rounding * (dot(facing, point.largest) + max_of(largest_of(hit.position, hit.position)));
    hit.shading = shading_frame(point.shading, point.tangents);
    return hit;
}

Vec3 RayCaster::normal_change(const Hit& hit, const Vec3& displacement) const {
    std::optional<Placement> moved_to;
    const Placement* const placement = placement_of(hit.element.instance, hit.time, moved_to);
    const Vec3 moved = placement ? placement->object_from_world.vector(displacement) : displacement;
    Vec3 normal;
    Vec3 change;
    if (const auto* mesh = std::get_if<TriangleMesh>(&hit.surface->shape)) {
        if (mesh->normals.empty()) {
            return {0, 0, 0};
        }
        const std::uint32_t* i = &mesh->indices[3 * std::size_t{hit.element.primitive}];
        const Vec3 &p0 = mesh->positions[i[0]], &n0 = mesh->normals[i[0]];
        const Vec3 e1 = mesh->positions[i[1]] - p0, e2 = mesh->positions[i[2]] - p0;
        const Vec3 d1 = mesh->normals[i[1]] - n0, d2 = mesh->normals[i[2]] - n0;
        const Vec3 across = cross(e1, e2);
        const float area = length_squared(across);
        const auto interpolated = [&](const Vec3& along) {
            return d1 * (dot(cross(along, e2), across) / area) + d2 * (dot(cross(e1, along), across) / area);
        };
        const Vec3 place = placement ? placement->object_from_world.point(hit.position) : hit.position;
        normal = n0 + interpolated(place - p0);
        change = interpolated(moved);
    } else {
        const Vec3 place = placement ? placement->object_from_world.point(hit.position) : hit.position;
        const auto set = [&](const auto& solid) {
            const QuadricPoint point = project(solid, solid.object_from_world.point(place));
            normal = solid.object_from_world.transposed_vector(point.normal);
            change =
                solid.object_from_world.transposed_vector(solid.object_from_world.vector(moved) * point.normal_slope);
        };
        if (const auto* quadric = std::get_if<Quadric>(&hit.surface->shape)) {
            set(*quadric);
        } else if (const auto* cylinder = std::get_if<CylinderShell>(&hit.surface->shape)) {
            set(*cylinder);
        } else {
            return {0, 0, 0};  // curves are too thin for it to matter
        }
    }
    if (placement) {
        normal = placement->object_from_world.transposed_vector(normal);
        change = placement->object_from_world.transposed_vector(change);
    }
    const float size = length(normal);
    if (!(size > 0)) {
        return {0, 0, 0};
    }
    const Vec3 unit = normal / size;
    return (change - unit * dot(unit, change)) * ((dot(unit, hit.shading.n) < 0 ? -1.0f : 1.0f) / size);
}

SurfaceDerivatives RayCaster::derivatives(const Hit& hit) const {
    std::optional<Placement> moved_to;
    const Placement* const placement = placement_of(hit.element.instance, hit.time, moved_to);
    SurfaceDerivatives d{hit.shading.s, hit.shading.t, {}, {}};
    if (const auto* mesh = std::get_if<TriangleMesh>(&hit.surface->shape)) {
        const std::uint32_t* i = &mesh->indices[3 * std::size_t{hit.element.primitive}];
        const Vec3 e1 = mesh->positions[i[1]] - mesh->positions[i[0]];
        const Vec3 e2 = mesh->positions[i[2]] - mesh->positions[i[0]];
        const bool has_uvs = !mesh->uvs.empty();
        const Vec2 d1 = has_uvs ? mesh->uvs[i[1]] - mesh->uvs[i[0]] : Vec2(1, 0);
        const Vec2 d2 = has_uvs ? mesh->uvs[i[2]] - mesh->uvs[i[0]] : Vec2(1, 1);
        if (const Tangents u = tangents(e1, e2, d1, d2); u.valid) {
            d.dpdu = u.dpdu;
            d.dpdv = tangents(e1, e2, Vec2(d1.y, d1.x), Vec2(d2.y, d2.x)).dpdu;
        }
    } else if (!std::holds_alternative<CurveSet>(hit.surface->shape)) {
        const Vec3 place = placement ? placement->object_from_world.point(hit.position) : hit.position;
        const auto set = [&](const auto& solid) {
            const QuadricTangents local = tangents(solid, solid.object_from_world.point(place));
            d.dpdu = solid.world_from_object.vector(local.dpdu);
            d.dpdv = solid.world_from_object.vector(local.dpdv);
        };
        const auto* quadric = std::get_if<Quadric>(&hit.surface->shape);
        quadric ? set(*quadric) : set(std::get<CylinderShell>(hit.surface->shape));
    } else {
        return d;  // the frame is in the world already, and what a curve is across has no length of its own
    }
    if (placement) {
        d.dpdu = placement->world_from_object.vector(d.dpdu);
        d.dpdv = placement->world_from_object.vector(d.dpdv);
    }
    d.dndu = normal_change(hit, d.dpdu);
    d.dndv = normal_change(hit, d.dpdv);
    return d;
}

Box3 RayCaster::bounds() const {
    RTCBounds b;
    rtcGetSceneBounds(scene_.get(), &b);
    return {Vec3(b.lower_x, b.lower_y, b.lower_z), Vec3(b.upper_x, b.upper_y, b.upper_z)};
}

}  // namespace wend
