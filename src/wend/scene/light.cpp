#include <wend/scene/light.h>

#include <wend/core/vector.h>
#include <wend/sampling/warp.h>
#include <wend/scene/moving_light.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Connection to a point on an area light, given the density of the point per world area.
std::optional<LightSample> connect(const Vec3& p, const Vec3& q, const Vec3& normal, const Vec2& uv, float area_density,
                                   const Light& light) {
    const Vec3 d = q - p;
    const float d2 = length_squared(d);
    if (!(d2 > 0)) {
        return std::nullopt;
    }
    const float distance = std::sqrt(d2);
    const Vec3 w = d / distance;
    const float cosine = abs_dot(normal, w);
    const Rgb radiance = emitted_radiance(light, normal, uv, -w);
    if (is_black(radiance) || !(cosine > 1e-7f)) {
        return std::nullopt;
    }
    return LightSample{w, distance, radiance, area_density * d2 / cosine, is_point_like(light), -1, uv, normal};
}

/// To a point whose intensity towards p is `intensity(w)`, w pointing away from it.
template <class Intensity>
std::optional<LightSample> connect_to_point(const Vec3& position, const Vec3& p, const Intensity& intensity) {
    const Vec3 d = position - p;
    const float d2 = length_squared(d);
    if (!(d2 > 0)) {
        return std::nullopt;
    }
    const float distance = std::sqrt(d2);
    const Vec3 w = d / distance;
    const Rgb radiance = intensity(-w) / d2;
    return is_black(radiance) ? std::nullopt : std::optional(LightSample{w, distance, radiance, 1, true});
}

/// The part of a full sphere that a point (object space) outside it can see: a cap around the direction to the point.
struct Cap {
    Vec3 axis;
    float height_fraction;  ///< of the sphere's area
};
Cap visible_cap(const Sphere& sphere, const Vec3& from) {
    const float distance = length(from);
    if (!sphere.is_full() || distance <= sphere.radius) {
        return {{0, 0, 1}, 1};
    }
    return {from / distance, 0.5f * (1 - sphere.radius / distance)};
}

/// Below, the inverse of a triangle's area and its products leave the range of floats.
constexpr float smallest_area = 1e-30f;

struct ShapePoint {
    Vec3 position;
    Vec3 normal;
    float density;  ///< per object-space area
};

ShapePoint sample_shape(const Sphere& s, const Vec3& from, float area, const Vec2& u) {
    if (!s.is_full()) {
        const float z_low = std::max(s.z_min, -s.radius);
        const float z_high = std::min(s.z_max, s.radius);
        const float z = z_low + u.x * (z_high - z_low);
        const float r = safe_sqrt(s.radius * s.radius - z * z);
        const float phi = u.y * s.phi_max;
        const Vec3 p(r * std::cos(phi), r * std::sin(phi), z);
        return {p, p, 1 / area};
    }
    const Cap cap = visible_cap(s, from);
    const Vec3 n = Frame::from_z(cap.axis).to_world(to_cone(u, 2 * cap.height_fraction));
    return {n * s.radius, n, 1 / (area * cap.height_fraction)};
}

ShapePoint sample_shape(const Disk& s, const Vec3&, float area, const Vec2& u) {
    const float r = std::sqrt(sqr(s.inner_radius) + u.x * (sqr(s.radius) - sqr(s.inner_radius)));
    const float phi = u.y * s.phi_max;
    return {{r * std::cos(phi), r * std::sin(phi), s.height}, {0, 0, 1}, 1 / area};
}

/// Density per object-space area with which sample_shape yields the object-space point q.
float shape_density(const Sphere& s, const Vec3& from, float area, const Vec3& q) {
    const Cap cap = visible_cap(s, from);
    if (cap.height_fraction < 1 && dot(q, cap.axis) < s.radius * (1 - 2 * cap.height_fraction)) {
        return 0;
    }
    return 1 / (area * cap.height_fraction);
}

float shape_density(const Disk&, const Vec3&, float area, const Vec3&) {
    return 1 / area;
}

/// World area of a small patch over its object area, where the object-space unit normal is n.
float area_stretch(const PlacedQuadric& placed, const Vec3& n) {
    return placed.area_factor() * length(placed.normal(n));
}

std::optional<LightSample> sample(const PointLight& l, const Vec3& p, const Vec2&, const Light&, Pcg32&) {
    return connect_to_point(l.position, p, [&](const Vec3&) { return l.intensity; });
}
template <class Directional>
std::optional<LightSample> sample_directional(const Directional& l, const Vec3& p) {
    return connect_to_point(l.position, p, [&](const Vec3& w) { return intensity_towards(l, w); });
}
std::optional<LightSample> sample(const SpotLight& l, const Vec3& p, const Vec2&, const Light&, Pcg32&) {
    return sample_directional(l, p);
}
std::optional<LightSample> sample(const GoniometricLight& l, const Vec3& p, const Vec2&, const Light&, Pcg32&) {
    return sample_directional(l, p);
}
std::optional<LightSample> sample(const ProjectionLight& l, const Vec3& p, const Vec2&, const Light&, Pcg32&) {
    return sample_directional(l, p);
}
std::optional<LightSample> sample(const PortalInfiniteLight& l, const Vec3& p, const Vec2& u, const Light&, Pcg32&) {
    const auto s = l.portal->sample(p, u);
    return s ? std::optional(LightSample{s->direction, infinity, s->radiance, s->density, false}) : std::nullopt;
}
std::optional<LightSample> sample(const DistantLight& l, const Vec3&, const Vec2&, const Light&, Pcg32&) {
    return LightSample{l.direction, infinity, l.radiance, 1, true};
}
std::optional<LightSample> sample(const SkyDiskLight& l, const Vec3&, const Vec2& u, const Light&, Pcg32&) {
    const Vec3 w = Frame::from_z(l.direction).to_world(to_cone(u, l.one_minus_cosine));
    return LightSample{w, infinity, l.radiance, cone_density(l.one_minus_cosine), false};
}
/// Of small disks, cosines would not tell.
bool is_within(const SkyDiskLight& l, const Vec3& direction) {
    return length_squared(direction - l.direction) <= 2 * l.one_minus_cosine;
}
std::optional<LightSample> sample(const UniformInfiniteLight& l, const Vec3&, const Vec2& u, const Light&, Pcg32&) {
    return LightSample{to_sphere(u), infinity, l.radiance, inv_4pi, false};
}
std::optional<LightSample> sample(const ImageInfiniteLight& l, const Vec3&, const Vec2& u, const Light&, Pcg32&) {
    const LightSample s = l.sample(u);
    return s.density > 0 ? std::optional(s) : std::nullopt;
}
std::optional<LightSample> sample_area(const TriangleLight& l, const Vec3& p, const Vec2& u, const Light& light,
                                       float time) {
    const PlacedTriangle t = placed_at(l, time);
    if (l.motion && !(t.area > smallest_area)) {
        return std::nullopt;
    }
    const Vec2 b = to_triangle(u);
    const float w = 1 - b.x - b.y;
    return connect(p, t.p0 * w + t.p1 * b.x + t.p2 * b.y, t.normal, l.uv0 * w + l.uv1 * b.x + l.uv2 * b.y, 1 / t.area,
                   light);
}
std::optional<LightSample> sample_area(const QuadricLight& l, const Vec3& p, const Vec2& u, const Light& light,
                                       float time) {
    const Quadric& quadric = *l.quadric;
    const PlacedQuadric placed(l, time);
    const Vec3 from = placed.to_object(p);
    const ShapePoint point =
        std::visit([&](const auto& s) { return sample_shape(s, from, l.object_area, u); }, quadric.shape);
    const Vec3 n = normalize(point.normal);
    const Vec3 world_normal = normalize(placed.normal(n)) * l.flip;
    return connect(p, placed.to_world(point.position), world_normal, parameters(quadric, point.position),
                   point.density / area_stretch(placed, n), light);
}

std::optional<LightSample> sample(const MediumLight& l, const Vec3& p, const Vec2& u, const Light&, Pcg32& random) {
    const EmissionSampler& glow = *l.grid->glow();
    const EmissionSampler::Sample point = glow.sample(u, random.uniform());
    const float distance = length(point.position - p);
    const Rgb radiance = l.grid->emitted_at(point.position) * glow.unit();
    if (!(distance > 0) || is_black(radiance)) {
        return std::nullopt;
    }
    return LightSample{(point.position - p) / distance,
                       distance,
                       radiance,
                       glow.seen_from(p, point.position, point.density),
                       false,
                       l.medium};
}

float solid_angle_density(float area_density, const Vec3& p, const Vec3& direction, const Vec3& hit,
                          const Vec3& normal) {
    const float cosine = abs_dot(normal, direction);
    return cosine > 1e-7f ? area_density * length_squared(hit - p) / cosine : 0.0f;
}

}  // namespace

std::optional<LightSample> sample_light(const Light& light, const Vec3& p, const Vec2& u, Pcg32& random, float time) {
    return std::visit(
        [&](const auto& l) {
            if constexpr (requires { sample_area(l, p, u, light, time); }) {
                return sample_area(l, p, u, light, time);
            } else {
                return sample(l, p, u, light, random);
            }
        },
        light);
}

float light_density(const Light& light, const Vec3& p, const Vec3& direction, const Vec3& hit, const Vec3& hit_normal,
                    float time) {
    if (const auto* triangle = std::get_if<TriangleLight>(&light)) {
        const float area = triangle->motion ? placed_at(*triangle, time).area : triangle->area;
        return triangle->motion && !(area > smallest_area)
                   ? 0.0f
                   : solid_angle_density(1 / area, p, direction, hit, hit_normal);
    }
    if (const auto* l = std::get_if<QuadricLight>(&light)) {
        const Quadric& quadric = *l->quadric;
        const PlacedQuadric placed(*l, time);
        const Vec3 from = placed.to_object(p);
        const Vec3 q = placed.to_object(hit);
        const float density =
            std::visit([&](const auto& s) { return shape_density(s, from, l->object_area, q); }, quadric.shape);
        const Vec3 n = std::holds_alternative<Sphere>(quadric.shape) ? normalize(q) : Vec3(0, 0, 1);
        return solid_angle_density(density / area_stretch(placed, n), p, direction, hit, hit_normal);
    }
    if (std::holds_alternative<UniformInfiniteLight>(light)) {
        return inv_4pi;
    }
    if (const auto* disk = std::get_if<SkyDiskLight>(&light)) {
        return is_within(*disk, direction) ? cone_density(disk->one_minus_cosine) : 0.0f;
    }
    if (const auto* image = std::get_if<ImageInfiniteLight>(&light)) {
        return image->density(direction);
    }
    if (const auto* window = std::get_if<PortalInfiniteLight>(&light)) {
        return window->portal->density(p, direction);
    }
    if (const auto* glowing = std::get_if<MediumLight>(&light)) {
        const EmissionSampler& glow = *glowing->grid->glow();
        return glow.seen_from(p, hit, glow.density(hit));
    }
    return 0;
}

namespace {

/// What is asked of either kind of area light: nothing of others.
template <class Ask>
auto ask_area_light(const Light& light, const Ask& ask)
    -> std::optional<decltype(ask(std::get<TriangleLight>(light)))> {
    if (const auto* triangle = std::get_if<TriangleLight>(&light)) {
        return ask(*triangle);
    }
    if (const auto* quadric = std::get_if<QuadricLight>(&light)) {
        return ask(*quadric);
    }
    return std::nullopt;
}

/// Averaged over the picture and the directions, if they differ.
template <class AreaLight>
float mean_radiance(const AreaLight& light) {
    const Rgb radiance = light.picture ? light.radiance * light.picture->mean_colour() : light.radiance;
    return mean(light.profile ? radiance * light.profile->mean() : radiance);
}

}  // namespace

bool emits_towards(const Light& light, const Vec3& normal, const Vec3& w) {
    return ask_area_light(light, [&](const auto& l) { return l.two_sided || dot(normal, w) > 0; }).value_or(false);
}

Rgb emitted_radiance(const Light& light, const Vec3& normal, const Vec2& uv, const Vec3& w) {
    if (!emits_towards(light, normal, w)) {
        return Rgb(0.0f);
    }
    return *ask_area_light(light, [&](const auto& l) {
        const Rgb radiance = l.profile ? l.radiance * l.profile->towards(normal, w) : l.radiance;
        return l.picture ? radiance * l.picture->bilinear({uv.x, 1 - uv.y}) : radiance;
    });
}

Rgb environment_radiance(const Light& light, const Vec3& p, const Vec3& direction) {
    if (const auto* uniform = std::get_if<UniformInfiniteLight>(&light)) {
        return uniform->radiance;
    }
    if (const auto* disk = std::get_if<SkyDiskLight>(&light)) {
        return is_within(*disk, direction) ? disk->radiance : Rgb(0.0f);
    }
    if (const auto* image = std::get_if<ImageInfiniteLight>(&light)) {
        return image->radiance(direction);
    }
    if (const auto* window = std::get_if<PortalInfiniteLight>(&light)) {
        return window->portal->radiance(p, direction);
    }
    return Rgb(0.0f);
}

bool is_at_infinity(const Light& light) {
    return std::holds_alternative<UniformInfiniteLight>(light) || std::holds_alternative<ImageInfiniteLight>(light) ||
           std::holds_alternative<DistantLight>(light) || std::holds_alternative<PortalInfiniteLight>(light) ||
           std::holds_alternative<SkyDiskLight>(light);
}

Presence presence_of(const Light& light) {
    return ask_area_light(light, [](const auto& l) { return l.presence; }).value_or(Presence::solid);
}

bool is_point_like(const Light& light) {
    return std::holds_alternative<PointLight>(light) || std::holds_alternative<DistantLight>(light) ||
           std::holds_alternative<SpotLight>(light) || std::holds_alternative<GoniometricLight>(light) ||
           std::holds_alternative<ProjectionLight>(light) || presence_of(light) == Presence::unseen;
}

float light_power(const Light& light, float scene_radius) {
    struct Power {
        float disk;
        float operator()(const PointLight& l) const { return 4 * pi * mean(l.intensity); }
        float operator()(const DistantLight& l) const { return disk * mean(l.radiance); }
        float operator()(const UniformInfiniteLight& l) const { return 4 * pi * disk * mean(l.radiance); }
        float operator()(const SkyDiskLight& l) const { return 2 * pi * l.one_minus_cosine * disk * mean(l.radiance); }
        float operator()(const ImageInfiniteLight& l) const { return 4 * pi * disk * mean(l.mean_radiance()); }
        float operator()(const TriangleLight& l) const {
            return (l.two_sided ? 2 : 1) * pi * l.area * mean_radiance(l);
        }
        float operator()(const QuadricLight& l) const {
            const float determinant = PlacedQuadric(l, 0).area_factor();
            return (l.two_sided ? 2 : 1) * pi * l.object_area * std::pow(determinant, 2.0f / 3) * mean_radiance(l);
        }
        float operator()(const SpotLight& l) const { return spread(l) * mean(l.intensity); }
        float operator()(const GoniometricLight& l) const { return mean(l.intensity * spread(l)); }
        float operator()(const ProjectionLight& l) const { return mean(l.intensity * spread(l)); }
        float operator()(const PortalInfiniteLight& l) const { return mean(l.portal->power()); }
        float operator()(const MediumLight& l) const { return 4 * pi * l.grid->glow()->power(); }
    };
    return std::visit(Power{pi * scene_radius * scene_radius}, light);
}

TriangleLight make_triangle_light(const Vec3& p0, const Vec3& p1, const Vec3& p2, bool flip, const Rgb& radiance,
                                  bool two_sided) {
    const Vec3 n = cross(p1 - p0, p2 - p0);
    const float l = length(n);
    return {p0, p1, p2, l > 0 ? n * ((flip ? -1 : 1) / l) : Vec3(0, 0, 1), 0.5f * l, radiance, two_sided};
}

QuadricLight make_quadric_light(std::shared_ptr<const Quadric> quadric, const Transform& world_from_object, bool flip,
                                const Rgb& radiance, bool two_sided) {
    struct Area {
        float operator()(const Sphere& s) const {
            return s.phi_max * s.radius * (std::min(s.z_max, s.radius) - std::max(s.z_min, -s.radius));
        }
        float operator()(const Disk& s) const { return 0.5f * s.phi_max * (sqr(s.radius) - sqr(s.inner_radius)); }
    };
    const float area = std::visit(Area{}, quadric->shape);
    return {std::move(quadric),
            flip ? -1.0f : 1.0f,
            radiance,
            two_sided,
            area,
            static_cast<float>(std::abs(world_from_object.determinant()))};
}

}  // namespace wend
