#include <wend/light/specular_chain.h>

#include <wend/medium/fresnel.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace wend {
namespace {

/// A lamp behind more of them, as behind the two sides of several panes, is left to chance.
constexpr int most_refractions = 8;

/// A ray and how it changes with two angles of the way's first direction (igehy1999).
struct Pencil {
    TracedRay ray;
    std::array<Vec3, 2> origin_by{Vec3(0, 0, 0), Vec3(0, 0, 0)};
    std::array<Vec3, 2> direction_by;

    /// Moves the origin to where the ray is after `length`, on a surface with this normal.
    void move(float length, const Vec3& normal) {
        for (std::size_t i = 0; i < 2; ++i) {
            const Vec3 moved = origin_by[i] + direction_by[i] * length;
            origin_by[i] = moved - ray.direction * (dot(moved, normal) / dot(ray.direction, normal));
        }
    }
};

/// Where a way is to lead: to a point, or into a direction.
struct Target {
    Vec3 place;
    bool is_far;

    /// Nothing where the ray leads away.
    std::optional<float> distance_along(const Ray& ray) const {
        const float along = dot(is_far ? place : place - ray.origin, ray.direction);
        return along > 0 ? std::optional(is_far ? infinity : along) : std::nullopt;
    }
};

/// What following a first direction leads to.
struct Trial {
    SpecularChain way;
    Pencil last;
    /// By how much the last ray misses the target, across, and how that shrinks with the angles.
    Vec3 missed;
    std::array<Vec3, 2> approach;
    bool is_clear = false;  ///< nothing is in the way of the last ray

    /// At the end of the last ray, where it is `along` from the target.
    void measure(const Target& target, float along) {
        const Vec3& w = last.ray.direction;
        const auto across = [&](const Vec3& v) { return v - w * dot(v, w); };
        missed = across(target.is_far ? target.place : target.place - last.ray.origin);
        for (std::size_t i = 0; i < 2; ++i) {
            approach[i] =
                across(target.is_far ? last.direction_by[i] : last.origin_by[i] + last.direction_by[i] * along);
        }
    }
};

/// None where another ray may find something else, or another normal than that of the shape.
const DielectricBsdf* smooth_dielectric(const Scene& scene, const Hit& hit, const Bsdf& bsdf) {
    const auto* dielectric = std::get_if<DielectricBsdf>(&bsdf);
    return dielectric && dielectric->is_specular() && scene.is_plain(hit) ? dielectric : nullptr;
}

/// Refracts the beam, whose origin is at the hit. False where it is totally reflected.
bool refract_at(const Scene& scene, const Hit& hit, const DielectricBsdf& boundary, Pencil& beam, SpecularChain& way) {
    const Vec3 before = beam.ray.direction;
    Vec3 n = hit.shading.n;
    const auto refracted = refract(-before, n, boundary.ior);
    if (!refracted || !(dot(refracted->direction, hit.normal) * dot(before, hit.normal) > 0)) {
        return false;
    }
    const float side = dot(n, before) < 0 ? 1.0f : -1.0f;
    n *= side;
    const float cosine = -dot(n, before), cosine_beyond = -dot(n, refracted->direction);
    if (!(cosine > 0) || !(cosine_beyond > 0)) {
        return false;
    }
    const float index = refracted->ior;
    for (std::size_t i = 0; i < 2; ++i) {
        const Vec3 turned = scene.normal_change(hit, beam.origin_by[i]) * side;
        const float cosine_by = -(dot(beam.direction_by[i], n) + dot(before, turned));
        const float beyond_by = cosine * cosine_by / (sqr(index) * cosine_beyond);
        beam.direction_by[i] = beam.direction_by[i] / index + turned * (cosine / index - cosine_beyond) +
                               n * (cosine_by / index - beyond_by);
    }
    way.transmitted *= boundary.transmittance * ((1 - boundary.reflected_share(cosine * side)) / sqr(index));
    ++way.refractions;
    beam.ray = beam.ray.leave(hit, refracted->direction);
    return true;
}

/// Follows a way from where the straight one starts along first.n to where it comes closest to the target. Behind so
/// many refractions nothing is traced any more. Nothing where the way turns back, is totally reflected, or is too long.
std::optional<Trial> follow(const Scene& scene, const Ray& straight, const Frame& first, const Target& target,
                            MediumState medium, int refractions) {
    Trial trial;
    trial.way.direction = first.n;
    Pencil beam;
    beam.ray = Ray{straight.origin, first.n, straight.time};
    beam.direction_by = {first.s, first.t};
    for (;;) {
        const std::optional<float> along = target.distance_along(beam.ray);
        if (!along) {
            return std::nullopt;
        }
        constexpr float margin = 1e-3f;
        const std::optional<Hit> hit =
            trial.way.refractions < refractions ? scene.intersect(beam.ray, *along * (1 + margin)) : std::nullopt;
        const bool passes = hit && hit->light < 0 && hit->distance < *along * (1 - margin);
        const bool is_interface = passes && scene.is_interface(*hit);
        const Bsdf bsdf = passes && !is_interface ? scene.bsdf(*hit) : Bsdf();
        const DielectricBsdf* const dielectric =
            passes && !is_interface ? smooth_dielectric(scene, *hit, bsdf) : nullptr;
        if (!trial.way.add({beam.ray, hit ? hit->distance : *along, medium.id, trial.way.refractions})) {
            return std::nullopt;
        }
        if (!is_interface && !dielectric) {
            trial.last = beam;
            trial.measure(target, *along);
            if (hit && hit->light >= 0 && length(hit->position - target.place) < margin * *along) {
                trial.way.end = *hit;
            }
            trial.is_clear = target.is_far ? !hit : trial.way.end.surface != nullptr;
            return trial;
        }
        beam.move(hit->distance, hit->normal);
        if (is_interface) {
            beam.ray.pass(*hit);
        } else if (!refract_at(scene, *hit, *dielectric, beam, trial.way)) {
            return std::nullopt;
        } else if (scene.counts_vertices_in(medium.id)) {
            ++trial.way.vertices;
        }
        medium = scene.medium_beyond(*hit, beam.ray.direction, medium);
    }
}

/// Where a straight ray is totally reflected, the one that leaves the boundary as the straight one goes on.
std::optional<Vec3> steeper(const Scene& scene, const Ray& straight, float distance) {
    const std::optional<Hit> hit = scene.intersect(straight, distance);
    if (!hit || hit->light >= 0 || scene.is_interface(*hit)) {
        return std::nullopt;
    }
    const Bsdf bsdf = scene.bsdf(*hit);
    const DielectricBsdf* const dielectric = smooth_dielectric(scene, *hit, bsdf);
    const auto inside = dielectric ? refract(straight.direction, hit->shading.n, dielectric->ior) : std::nullopt;
    return inside ? std::optional(-inside->direction) : std::nullopt;
}

/// How the first direction is to turn, along the trial's frame, so that the way passes the target; to first order.
std::optional<Vec2> newton_step(const Trial& trial) {
    constexpr float most_turned = 0.3f;
    const Vec3 &w = trial.last.ray.direction, &a = trial.approach[0], &b = trial.approach[1];
    const float area = dot(cross(a, b), w);
    const Vec2 step = Vec2(dot(cross(trial.missed, b), w), dot(cross(a, trial.missed), w)) / area;
    const float size = std::sqrt(step.x * step.x + step.y * step.y);
    return std::isfinite(size) ? std::optional(step * std::min(1.0f, most_turned / size)) : std::nullopt;
}

/// Of the first direction, over that of the straight one.
float density_ratio(const Trial& trial, const Ray& straight, float distance) {
    const float spread = length(cross(trial.approach[0], trial.approach[1]));
    if (distance == infinity) {
        return spread;
    }
    const Vec3& normal = trial.way.end.normal;
    return abs_dot(normal, straight.direction) * spread / (sqr(distance) * abs_dot(normal, trial.last.ray.direction));
}

}  // namespace

std::optional<SpecularChain> find_specular_chain(const Scene& scene, const Ray& straight, float distance,
                                                 const MediumState& medium) {
    constexpr int most_trials = 12;
    constexpr float least_part = 1.0f / 8, least_gain = 0.25f;
    const bool is_far = distance == infinity;
    const Target target{is_far ? straight.direction : straight.at(distance), is_far};
    const float close = is_far ? 1e-5f : 1e-5f * distance + 4e-7f * length(target.place);
    std::optional<Trial> best =
        follow(scene, straight, Frame::from_z(straight.direction), target, medium, most_refractions);
    if (!best) {
        if (const auto direction = steeper(scene, straight, distance)) {
            best = follow(scene, straight, Frame::from_z(*direction), target, medium, most_refractions);
        }
    }
    if (!best || best->way.refractions == 0) {
        return std::nullopt;
    }
    const auto passes_target = [&] { return length_squared(best->missed) < sqr(close); };
    auto step = newton_step(*best);
    float part = 1;
    for (int i = 0; i < most_trials && !passes_target() && step && part >= least_part; ++i) {
        const Frame base = Frame::from_z(best->way.direction);
        const Vec3 direction = normalize(base.n + base.s * (step->x * part) + base.t * (step->y * part));
        std::optional<Trial> trial =
            follow(scene, straight, Frame::from_z(direction), target, medium, best->way.refractions);
        if (trial && length(trial->missed) < (1 - least_gain * part) * length(best->missed)) {
            best = std::move(trial);
            step = newton_step(*best);
            part = 1;
        } else {
            part *= 0.5f;
        }
    }
    if (!passes_target()) {
        return std::nullopt;
    }
    // With what lies behind the last boundary.
    best = follow(scene, straight, Frame::from_z(best->way.direction), target, medium, most_refractions);
    if (!best || !passes_target() || !best->is_clear) {
        return std::nullopt;
    }
    best->way.density_ratio = density_ratio(*best, straight, distance);
    return best->way.density_ratio > 0 && std::isfinite(best->way.density_ratio) ? std::optional(best->way)
                                                                                 : std::nullopt;
}

}  // namespace wend
