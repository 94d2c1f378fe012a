#include <wend/integrator/refracted_way.h>
#include <wend/medium/fresnel.h>

#include <algorithm>
#include <utility>
#include <variant>

namespace wend {
namespace {

/// Vessels have a few; what has more is no window.
constexpr int most_refractions = 8;

/// A ray and how it changes with two angles of the way's first direction (igehy1999).
struct Beam {
    Ray ray;
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

/// What following a first direction leads to.
struct Trial {
    RefractedWay way;
    Beam last;
    /// From where the last ray passes the target to the target, and how the former moves.
    Vec3 missed;
    std::array<Vec3, 2> passing_by;
    bool is_clear = false;  ///< nothing is in the way of the last ray
};

const DielectricBsdf* smooth_dielectric(const Bsdf& bsdf) {
    const auto* dielectric = std::get_if<DielectricBsdf>(&bsdf);
    return dielectric && dielectric->is_specular() ? dielectric : nullptr;
}

/// Refracts the beam, whose origin is at the hit. False where it is totally reflected.
bool refract_at(const Scene& scene, const Hit& hit, float ior, Beam& beam, RefractedWay& way) {
    const Vec3 before = beam.ray.direction;
    Vec3 n = hit.shading.n;
    const auto refracted = refract(-before, n, ior);
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
    way.transmitted *= (1 - fresnel_dielectric(cosine * side, ior)) / sqr(index);
    ++way.refractions;
    beam.ray = spawn_ray(hit.position, hit.normal, refracted->direction);
    return true;
}

/// Follows a way to where it passes the target, and no further than `refractions`, behind which nothing is traced if
/// that is less than what there may be. Nothing where the way turns back, is totally reflected, or is too long.
std::optional<Trial> follow(const Scene& scene, const Vec3& from, const Frame& first, const Vec3& target,
                            MediumId medium, int refractions) {
    Trial trial;
    trial.way.direction = first.n;
    Beam beam;
    beam.ray = {from, first.n};
    beam.direction_by = {first.s, first.t};
    for (;;) {
        const Vec3 rest = target - beam.ray.origin;
        const float along = dot(rest, beam.ray.direction);
        if (!(along > 0)) {
            return std::nullopt;
        }
        constexpr float margin = 1e-3f;
        const std::optional<Hit> hit =
            trial.way.refractions < refractions ? scene.intersect(beam.ray, along * (1 + margin)) : std::nullopt;
        const bool passes = hit && hit->light < 0 && hit->distance < along * (1 - margin);
        const bool is_interface = passes && scene.is_interface(*hit);
        const Bsdf bsdf = passes && !is_interface ? scene.bsdf(*hit) : Bsdf();
        const DielectricBsdf* const dielectric = smooth_dielectric(bsdf);
        if (!trial.way.add({beam.ray, hit ? hit->distance : along, medium})) {
            return std::nullopt;
        }
        if (!is_interface && !dielectric) {
            trial.last = beam;
            trial.missed = rest - beam.ray.direction * along;
            for (std::size_t i = 0; i < 2; ++i) {
                const Vec3 by = beam.origin_by[i] + beam.direction_by[i] * along;
                trial.passing_by[i] = by - beam.ray.direction * dot(by, beam.ray.direction);
            }
            if (hit && hit->light >= 0 && length(hit->position - target) < margin * along) {
                trial.way.end = *hit;
                trial.is_clear = true;
            }
            return trial;
        }
        beam.move(hit->distance, hit->normal);
        if (is_interface) {
            beam.ray = spawn_ray(hit->position, hit->normal, beam.ray.direction);
        } else if (!refract_at(scene, *hit, dielectric->ior, beam, trial.way)) {
            return std::nullopt;
        }
        medium = scene.medium_beyond(*hit, beam.ray.direction, medium);
    }
}

/// Where a straight ray is totally reflected, the one that leaves the boundary as the straight one goes on.
std::optional<Vec3> steeper(const Scene& scene, const Ray& straight, float distance) {
    const std::optional<Hit> hit = scene.intersect(straight, distance);
    if (!hit || hit->light >= 0) {
        return std::nullopt;
    }
    const Bsdf bsdf = scene.bsdf(*hit);
    const DielectricBsdf* const dielectric = smooth_dielectric(bsdf);
    const auto inside = dielectric ? refract(straight.direction, hit->shading.n, dielectric->ior) : std::nullopt;
    return inside ? std::optional(-inside->direction) : std::nullopt;
}

}  // namespace

std::optional<RefractedWay> find_refracted_way(const Scene& scene, const Ray& straight, float distance,
                                               MediumId medium) {
    constexpr int most_trials = 12;
    constexpr float most_turned = 0.3f, least_part = 1.0f / 8, least_gain = 0.25f;
    const Vec3 target = straight.at(distance);
    const float close = 1e-5f * distance + 4e-7f * std::sqrt(length_squared(target));
    Vec3 direction = straight.direction;
    std::optional<Trial> best;
    Frame base;
    Vec2 turn(0, 0);
    float part = 1;
    int refractions = most_refractions;
    for (int i = 0; i < most_trials; ++i) {
        const Frame first = Frame::from_z(direction);
        std::optional<Trial> trial = follow(scene, straight.origin, first, target, medium, refractions);
        if (i == 0 && !trial) {
            const auto other = steeper(scene, straight, distance);
            if (!other) {
                return std::nullopt;
            }
            direction = *other;
            continue;
        }
        if (!best && (!trial || trial->way.refractions == 0)) {
            return std::nullopt;
        }
        if (trial && (!best || length(trial->missed) < (1 - least_gain * part) * length(best->missed))) {
            best = std::move(trial);
            base = first;
            part = 1;
            refractions = best->way.refractions;
            if (length_squared(best->missed) < sqr(close)) {
                break;
            }
            const Vec3 &w = best->last.ray.direction, &a = best->passing_by[0], &b = best->passing_by[1];
            const float area = dot(cross(a, b), w);
            turn = Vec2(dot(cross(best->missed, b), w), dot(cross(a, best->missed), w)) / area;
            const float size = std::sqrt(turn.x * turn.x + turn.y * turn.y);
            if (!std::isfinite(size)) {
                return std::nullopt;
            }
            turn *= std::min(1.0f, most_turned / size);
        } else if ((part *= 0.5f) < least_part) {
            return std::nullopt;
        }
        direction = normalize(base.n + base.s * (turn.x * part) + base.t * (turn.y * part));
    }
    if (!best || !(length_squared(best->missed) < sqr(close))) {
        return std::nullopt;
    }
    best = follow(scene, straight.origin, base, target, medium, most_refractions);
    if (!best || !best->is_clear || best->way.refractions == 0) {
        return std::nullopt;
    }
    RefractedWay& way = best->way;
    const float spread = length(cross(best->passing_by[0], best->passing_by[1]));
    const float facing = abs_dot(way.end.normal, straight.direction),
                facing_last = abs_dot(way.end.normal, best->last.ray.direction);
    way.density_ratio = facing * spread / (sqr(distance) * facing_last);
    if (!(way.density_ratio > 0) || !std::isfinite(way.density_ratio)) {
        return std::nullopt;
    }
    return way;
}

}  // namespace wend
