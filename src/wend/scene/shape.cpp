#include <wend/scene/shape.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

constexpr float two_pi = 2 * pi;

float azimuth(const Vec3& p) {
    const float phi = std::atan2(p.y, p.x);
    return phi < 0 ? phi + two_pi : phi;
}

/// Whether a point of the whole sphere belongs to the part that is there.
bool is_kept(const Sphere& s, const Vec3& p) {
    if (s.is_full()) {
        return true;
    }
    const float z = p.z * (s.radius / length(p));
    return !((s.z_min > -s.radius && z < s.z_min) || (s.z_max < s.radius && z > s.z_max) || azimuth(p) > s.phi_max);
}

QuadricCrossings crossings_of(const Sphere& s, const Vec3& o, const Vec3& d) {
    QuadricCrossings found;
    // The quadratic about the point of the ray nearest to the centre: no cancellation for far origins (haines2019).
    const float a = length_squared(d);
    const float b = -dot(o, d);
    const Vec3 nearest = o + d * (b / a);
    const float discriminant = s.radius * s.radius - length_squared(nearest);
    if (!(discriminant >= 0)) {
        return found;
    }
    const float c = length_squared(o) - s.radius * s.radius;
    const float q = b + std::copysign(std::sqrt(a * discriminant), b);
    float t0 = q != 0 ? c / q : 0.0f;
    float t1 = q / a;
    if (t0 > t1) {
        std::swap(t0, t1);
    }
    for (const float t : {t0, t1}) {
        if (is_kept(s, o + d * t)) {
            found.add(t, t == t1);
        }
    }
    return found;
}

QuadricCrossings crossings_of(const Disk& s, const Vec3& o, const Vec3& d) {
    QuadricCrossings found;
    if (d.z == 0) {
        return found;
    }
    const float t = (s.height - o.z) / d.z;
    const Vec3 p = o + d * t;
    const float r2 = p.x * p.x + p.y * p.y;
    if (r2 <= sqr(s.radius) && r2 >= sqr(s.inner_radius) && azimuth(p) <= s.phi_max) {
        found.add(t, d.z > 0);
    }
    return found;
}

QuadricCrossings crossings_of(const Cylinder& s, const Vec3& o, const Vec3& d) {
    QuadricCrossings found;
    const float a = d.x * d.x + d.y * d.y;
    if (!(a > 0)) {
        return found;
    }
    // As of a sphere, in the plane across.
    const float b = -(o.x * d.x + o.y * d.y);
    const Vec2 nearest(o.x + d.x * (b / a), o.y + d.y * (b / a));
    const float discriminant = sqr(s.radius) - nearest.dot(nearest);
    if (!(discriminant >= 0)) {
        return found;
    }
    const float c = o.x * o.x + o.y * o.y - sqr(s.radius);
    const float q = b + std::copysign(std::sqrt(a * discriminant), b);
    float t0 = q != 0 ? c / q : 0.0f;
    float t1 = q / a;
    if (t0 > t1) {
        std::swap(t0, t1);
    }
    for (const float t : {t0, t1}) {
        const Vec3 p = o + d * t;
        if (p.z >= s.z_min && p.z <= s.z_max && azimuth(p) <= s.phi_max) {
            found.add(t, t == t1);
        }
    }
    return found;
}

Vec2 parameters_of(const Cylinder& s, const Vec3& p) {
    return {azimuth(p) / s.phi_max, std::clamp((p.z - s.z_min) / (s.z_max - s.z_min), 0.0f, 1.0f)};
}

QuadricPoint project_onto(const Cylinder& s, const Vec3& p) {
    const float scale = s.radius / std::hypot(p.x, p.y);
    return {{p.x * scale, p.y * scale, p.z}, {p.x, p.y, 0}, {-p.y, p.x, 0}, {1, 1, 0}};
}

QuadricTangents tangents_of(const Cylinder& s, const Vec3& p) {
    return {Vec3(-p.y, p.x, 0) * s.phi_max, Vec3(0, 0, s.z_max - s.z_min)};
}

Box3 object_bounds(const Cylinder& s) {
    return {Vec3(-s.radius, -s.radius, s.z_min), Vec3(s.radius, s.radius, s.z_max)};
}

Vec2 parameters_of(const Sphere& s, const Vec3& p) {
    const auto theta = [&](float z) { return std::acos(std::clamp(z / s.radius, -1.0f, 1.0f)); };
    const float theta_min = theta(s.z_min);
    return {azimuth(p) / s.phi_max, (theta(p.z) - theta_min) / (theta(s.z_max) - theta_min)};
}

Vec2 parameters_of(const Disk& s, const Vec3& p) {
    return {azimuth(p) / s.phi_max, (s.radius - std::sqrt(p.x * p.x + p.y * p.y)) / (s.radius - s.inner_radius)};
}

QuadricPoint project_onto(const Sphere& s, const Vec3& p) {
    const Vec3 on = p * (s.radius / length(p));
    return {on, on, {-on.y, on.x, 0}, {1, 1, 1}};
}

QuadricPoint project_onto(const Disk& s, const Vec3& p) {
    return {{p.x, p.y, s.height}, {0, 0, 1}, {-p.y, p.x, 0}, {0, 0, 0}};
}

QuadricTangents tangents_of(const Sphere& s, const Vec3& p) {
    const auto theta = [&](float z) { return std::acos(std::clamp(z / s.radius, -1.0f, 1.0f)); };
    const float across = std::max(std::hypot(p.x, p.y), 1e-12f);
    const Vec3 dpdtheta(p.z * p.x / across, p.z * p.y / across, -across);
    return {Vec3(-p.y, p.x, 0) * s.phi_max, dpdtheta * (theta(s.z_max) - theta(s.z_min))};
}

QuadricTangents tangents_of(const Disk& s, const Vec3& p) {
    const float r = std::max(std::hypot(p.x, p.y), 1e-12f);
    return {Vec3(-p.y, p.x, 0) * s.phi_max, Vec3(p.x, p.y, 0) * ((s.inner_radius - s.radius) / r)};
}

Box3 object_bounds(const Sphere& s) {
    return {Vec3(-s.radius, -s.radius, s.z_min), Vec3(s.radius, s.radius, s.z_max)};
}

Box3 object_bounds(const Disk& s) {
    return {Vec3(-s.radius, -s.radius, s.height), Vec3(s.radius, s.radius, s.height)};
}

template <class Part>
float extent_of(const Part& s) {
    const Box3 box = object_bounds(s);
    return std::max({-box.min.x, -box.min.y, -box.min.z, box.max.x, box.max.y, box.max.z});
}

Box3 placed(const Box3& local, const AffineMap& world_from_object) {
    Box3 world;
    for (int corner = 0; corner < 8; ++corner) {
        world.extendBy(
            world_from_object.point({corner & 1 ? local.max.x : local.min.x, corner & 2 ? local.max.y : local.min.y,
                                     corner & 4 ? local.max.z : local.min.z}));
    }
    return world;
}

}  // namespace

QuadricCrossings crossings(const Quadric& quadric, const Vec3& origin, const Vec3& direction) {
    return std::visit([&](const auto& s) { return crossings_of(s, origin, direction); }, quadric.shape);
}

QuadricCrossings crossings(const CylinderShell& cylinder, const Vec3& origin, const Vec3& direction) {
    return crossings_of(cylinder.shape, origin, direction);
}

float extent(const Quadric& quadric) {
    return std::visit([](const auto& s) { return extent_of(s); }, quadric.shape);
}

float extent(const CylinderShell& cylinder) {
    return extent_of(cylinder.shape);
}

Vec2 parameters(const Quadric& quadric, const Vec3& p) {
    return std::visit([&](const auto& s) { return parameters_of(s, p); }, quadric.shape);
}

Vec2 parameters(const CylinderShell& cylinder, const Vec3& p) {
    return parameters_of(cylinder.shape, p);
}

QuadricPoint project(const Quadric& quadric, const Vec3& p) {
    return std::visit([&](const auto& s) { return project_onto(s, p); }, quadric.shape);
}

QuadricPoint project(const CylinderShell& cylinder, const Vec3& p) {
    return project_onto(cylinder.shape, p);
}

QuadricTangents tangents(const Quadric& quadric, const Vec3& p) {
    return std::visit([&](const auto& s) { return tangents_of(s, p); }, quadric.shape);
}

QuadricTangents tangents(const CylinderShell& cylinder, const Vec3& p) {
    return tangents_of(cylinder.shape, p);
}

Box3 bounds(const Quadric& quadric) {
    return placed(std::visit([](const auto& s) { return object_bounds(s); }, quadric.shape), quadric.world_from_object);
}

Box3 bounds(const CylinderShell& cylinder) {
    return placed(object_bounds(cylinder.shape), cylinder.world_from_object);
}

Box3 bounds(const Shape& shape) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
        Box3 box;
        for (const auto* const positions : {&mesh->positions, &mesh->end_positions}) {
            for (const Vec3& p : *positions) {
                box.extendBy(p);
            }
        }
        return box;
    }
    if (const auto* quadric = std::get_if<Quadric>(&shape)) {
        return bounds(*quadric);
    }
    if (const auto* cylinder = std::get_if<CylinderShell>(&shape)) {
        return bounds(*cylinder);
    }
    return bounds(std::get<CurveSet>(shape));
}

}  // namespace wend
