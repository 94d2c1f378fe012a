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

bool hit_sphere_at(const Sphere& s, const Vec3& origin, const Vec3& direction, float t, QuadricHit& hit) {
    Vec3 p = origin + direction * t;
    p *= s.radius / length(p);
    const float phi = azimuth(p);
    if ((s.z_min > -s.radius && p.z < s.z_min) || (s.z_max < s.radius && p.z > s.z_max) || phi > s.phi_max) {
        return false;
    }
    const float theta = std::acos(std::clamp(p.z / s.radius, -1.0f, 1.0f));
    const float theta_min = std::acos(std::clamp(s.z_min / s.radius, -1.0f, 1.0f));
    const float theta_max = std::acos(std::clamp(s.z_max / s.radius, -1.0f, 1.0f));
    hit = {t, {phi / s.phi_max, (theta - theta_min) / (theta_max - theta_min)}};
    return true;
}

bool intersect_shape(const Sphere& s, const Vec3& o, const Vec3& d, float t_min, float t_max, QuadricHit& hit) {
    // The quadratic about the point of the ray nearest to the centre: no cancellation for far origins (haines2019).
    const float a = length_squared(d);
    const float b = -dot(o, d);
    const Vec3 nearest = o + d * (b / a);
    const float discriminant = s.radius * s.radius - length_squared(nearest);
    if (!(discriminant >= 0)) {
        return false;
    }
    const float c = length_squared(o) - s.radius * s.radius;
    const float q = b + std::copysign(std::sqrt(a * discriminant), b);
    float t0 = q != 0 ? c / q : 0.0f;
    float t1 = q / a;
    if (t0 > t1) {
        std::swap(t0, t1);
    }
    for (const float t : {t0, t1}) {
        if (t > t_min && t < t_max && hit_sphere_at(s, o, d, t, hit)) {
            return true;
        }
    }
    return false;
}

bool intersect_shape(const Disk& s, const Vec3& o, const Vec3& d, float t_min, float t_max, QuadricHit& hit) {
    if (d.z == 0) {
        return false;
    }
    const float t = (s.height - o.z) / d.z;
    if (!(t > t_min && t < t_max)) {
        return false;
    }
    Vec3 p = o + d * t;
    p.z = s.height;
    const float r2 = p.x * p.x + p.y * p.y;
    if (r2 > sqr(s.radius) || r2 < sqr(s.inner_radius)) {
        return false;
    }
    const float phi = azimuth(p);
    if (phi > s.phi_max) {
        return false;
    }
    hit = {t, {phi / s.phi_max, (s.radius - std::sqrt(r2)) / (s.radius - s.inner_radius)}};
    return true;
}

QuadricPoint project_onto(const Sphere& s, const Vec3& p) {
    const Vec3 on = p * (s.radius / length(p));
    return {on, on, {-on.y, on.x, 0}};
}

QuadricPoint project_onto(const Disk& s, const Vec3& p) {
    return {{p.x, p.y, s.height}, {0, 0, 1}, {-p.y, p.x, 0}};
}

Box3 object_bounds(const Sphere& s) {
    return {Vec3(-s.radius, -s.radius, s.z_min), Vec3(s.radius, s.radius, s.z_max)};
}

Box3 object_bounds(const Disk& s) {
    return {Vec3(-s.radius, -s.radius, s.height), Vec3(s.radius, s.radius, s.height)};
}

}  // namespace

bool intersect(const Quadric& quadric, const Vec3& origin, const Vec3& direction, float t_min, float t_max,
               QuadricHit& hit) {
    return std::visit([&](const auto& s) { return intersect_shape(s, origin, direction, t_min, t_max, hit); },
                      quadric.shape);
}

QuadricPoint project(const Quadric& quadric, const Vec3& p) {
    return std::visit([&](const auto& s) { return project_onto(s, p); }, quadric.shape);
}

Box3 bounds(const Quadric& quadric) {
    const Box3 local = std::visit([](const auto& s) { return object_bounds(s); }, quadric.shape);
    Box3 world;
    for (int corner = 0; corner < 8; ++corner) {
        world.extendBy(quadric.world_from_object.point({corner & 1 ? local.max.x : local.min.x,
                                                        corner & 2 ? local.max.y : local.min.y,
                                                        corner & 4 ? local.max.z : local.min.z}));
    }
    return world;
}

}  // namespace wend
