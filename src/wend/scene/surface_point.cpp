#include <wend/scene/surface_point.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// What a position and Embree's distance to it may be off by, over the coordinates that they are made of: some of the
/// spacings of floats, with room to spare (pharr2023, section 6.8).
constexpr float clearance_rounding = 1e-6f;

/// Magnitudes, by coordinate.
Vec3 largest_of(const Vec3& a, const Vec3& b) {
    return {std::max(std::abs(a.x), std::abs(b.x)), std::max(std::abs(a.y), std::abs(b.y)),
            std::max(std::abs(a.z), std::abs(b.z))};
}

float max_of(const Vec3& v) {
    return std::max({v.x, v.y, v.z});
}

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

/// A point of a surface in the space of its object.
struct LocalPoint {
    Vec3 position, normal, shading;
    Vec3 largest;  ///< of the coordinates that the position is made of
    Tangents tangents{};
};

/// Of the corners of a triangle, which also round as much as they do at both ends of their motion.
Vec3 largest_coordinates(const TriangleMesh& mesh, std::size_t triangle) {
    const auto [p0, p1, p2] = mesh.triangle(triangle, 0);
    const Vec3 largest = largest_of(largest_of(p0, p1), p2);
    if (!mesh.is_moving()) {
        return largest;
    }
    const auto [q0, q1, q2] = mesh.triangle(triangle, 1);
    return largest_of(largest, largest_of(largest_of(q0, q1), q2));
}

/// Fills in what of a hit on a mesh needs no placement.
LocalPoint point_of(const TriangleMesh& mesh, const RayHit& raw, bool has_tangent, Hit& hit) {
    const std::uint32_t* i = &mesh.indices[3 * std::size_t{raw.element.primitive}];
    const auto [p0, p1, p2] = mesh.triangle(raw.element.primitive, hit.time);
    const Vec3 e1 = p1 - p0;
    const Vec3 e2 = p2 - p0;
    const float w = 1 - raw.u - raw.v;
    LocalPoint point;
    hit.of_corners = {raw.u, raw.v};
    point.largest = largest_coordinates(mesh, raw.element.primitive);
    point.position = p0 + e1 * raw.u + e2 * raw.v;
    point.normal = cross(e1, e2);
    if (mesh.uvs.empty()) {
        const auto [uv1, uv2] = mesh.default_uvs(raw.element.primitive);
        hit.uv = uv1 * raw.u + uv2 * raw.v;
        if (has_tangent) {
            point.tangents = tangents(e1, e2, uv1, uv2);
        }
    } else {
        const Vec2 uv0 = mesh.uvs[i[0]], uv1 = mesh.uvs[i[1]], uv2 = mesh.uvs[i[2]];
        hit.uv = uv0 * w + uv1 * raw.u + uv2 * raw.v;
        point.tangents = tangents(e1, e2, uv1 - uv0, uv2 - uv0);
    }
    if (!mesh.tangents.empty()) {
        const Vec3 along = mesh.tangents[i[0]] * w + mesh.tangents[i[1]] * raw.u + mesh.tangents[i[2]] * raw.v;
        point.tangents = {along, length_squared(along) > 0};
    }
    if (mesh.normals.empty()) {
        hit.against_winding = hit.surface->flip_normal;
        point.normal = hit.against_winding ? -point.normal : point.normal;
        point.shading = point.normal;
    } else {
        const auto [n0, n1, n2] = mesh.corner_normals(raw.element.primitive, hit.time);
        point.shading = n0 * w + n1 * raw.u + n2 * raw.v;
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

Hit completed(const RayHit& raw, const Ray& ray, const Surface& surface, const Placement* placement,
              const AskedOfHit& asked) {
    Hit hit;
    hit.distance = raw.distance;
    hit.t = raw.t;
    hit.time = ray.time;
    hit.surface = &surface;
    hit.element = raw.element;
    hit.light = hit.surface->first_light < 0 ? -1 : hit.surface->first_light + static_cast<int>(raw.element.primitive);
    LocalPoint point;
    if (const auto* mesh = std::get_if<TriangleMesh>(hit.surface->shape.get())) {
        point = point_of(*mesh, raw, asked.tangent, hit);
    } else {
        const Vec3 in_world = ray.at(raw.distance);
        const Vec3 p = placement ? placement->object_from_world.point(in_world) : in_world;
        if (const auto* quadric = std::get_if<Quadric>(hit.surface->shape.get())) {
            point = point_of(*quadric, p, asked.uv, hit);
        } else if (const auto* cylinder = std::get_if<CylinderShell>(hit.surface->shape.get())) {
            point = point_of(*cylinder, p, asked.uv, hit);
        } else {
            const Vec3 way = placement ? placement->object_from_world.vector(ray.direction) : ray.direction;
            point = point_of(std::get<CurveSet>(*hit.surface->shape), raw, p, way, hit);
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
    hit.clearance = clearance_rounding * (dot(facing, point.largest) + max_of(largest_of(hit.position, hit.position)));
    hit.shading = shading_frame(point.shading, point.tangents);
    hit.facing = std::abs(dot(ray.direction, hit.shading.n));
    return hit;
}

Vec3 normal_change(const Hit& hit, const Placement* placement, const Vec3& displacement) {
    const Vec3 moved = placement ? placement->object_from_world.vector(displacement) : displacement;
    Vec3 normal;
    Vec3 change;
    if (const auto* mesh = std::get_if<TriangleMesh>(hit.surface->shape.get())) {
        if (mesh->normals.empty()) {
            return {0, 0, 0};
        }
        const auto corners = mesh->triangle(hit.element.primitive, hit.time);
        const auto normals = mesh->corner_normals(hit.element.primitive, hit.time);
        const Vec3 &p0 = corners[0], &n0 = normals[0];
        const Vec3 e1 = corners[1] - p0, e2 = corners[2] - p0;
        const Vec3 d1 = normals[1] - n0, d2 = normals[2] - n0;
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
        if (const auto* quadric = std::get_if<Quadric>(hit.surface->shape.get())) {
            set(*quadric);
        } else if (const auto* cylinder = std::get_if<CylinderShell>(hit.surface->shape.get())) {
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

SurfaceDerivatives surface_derivatives(const Hit& hit, const Placement* placement) {
    SurfaceDerivatives d{hit.shading.s, hit.shading.t, {}, {}};
    if (const auto* mesh = std::get_if<TriangleMesh>(hit.surface->shape.get())) {
        const std::uint32_t* i = &mesh->indices[3 * std::size_t{hit.element.primitive}];
        const auto [p0, p1, p2] = mesh->triangle(hit.element.primitive, hit.time);
        const Vec3 e1 = p1 - p0;
        const Vec3 e2 = p2 - p0;
        auto [d1, d2] = mesh->default_uvs(hit.element.primitive);
        if (!mesh->uvs.empty()) {
            d1 = mesh->uvs[i[1]] - mesh->uvs[i[0]];
            d2 = mesh->uvs[i[2]] - mesh->uvs[i[0]];
        }
        if (const Tangents u = tangents(e1, e2, d1, d2); u.valid) {
            d.dpdu = u.dpdu;
            d.dpdv = tangents(e1, e2, Vec2(d1.y, d1.x), Vec2(d2.y, d2.x)).dpdu;
        }
    } else if (!std::holds_alternative<CurveSet>(*hit.surface->shape)) {
        const Vec3 place = placement ? placement->object_from_world.point(hit.position) : hit.position;
        const auto set = [&](const auto& solid) {
            const QuadricTangents local = tangents(solid, solid.object_from_world.point(place));
            d.dpdu = solid.world_from_object.vector(local.dpdu);
            d.dpdv = solid.world_from_object.vector(local.dpdv);
        };
        const auto* quadric = std::get_if<Quadric>(hit.surface->shape.get());
        quadric ? set(*quadric) : set(std::get<CylinderShell>(*hit.surface->shape));
    } else {
        return d;  // the frame is in the world already, and what a curve is across has no length of its own
    }
    if (placement) {
        d.dpdu = placement->world_from_object.vector(d.dpdu);
        d.dpdv = placement->world_from_object.vector(d.dpdv);
    }
    d.dndu = normal_change(hit, placement, d.dpdu);
    d.dndv = normal_change(hit, placement, d.dpdv);
    return d;
}

}  // namespace wend
