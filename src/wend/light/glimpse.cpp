#include <wend/light/glimpse.h>
#include <wend/light/next_event.h>
#include <wend/medium/fresnel.h>
#include <wend/medium/transmittance.h>

#include <variant>

namespace wend {
namespace {

/// Vessels have a few; what has more is no window.
constexpr int most_crossings = 8;
constexpr int most_interfaces_met = 100;
/// Of what is fainter nothing is to be learned.
constexpr float least_transmittance = 1e-3f;
/// Directions towards an infinitely distant light that are taken for one.
constexpr float close_enough = 0.9998f;

/// Where a ray ends that is refracted by every boundary on its way.
struct Refracted {
    TracedRay last;  ///< after the last boundary
    Rgb transmittance{1.0f};
    int crossings = 0;
    enum class End { blocked, light, nothing } end = End::blocked;
};

Refracted follow(const Scene& scene, const Ray& start, MediumState medium, Pcg32& random) {
    Refracted way{start};
    for (int met = 0; met < most_interfaces_met; ++met) {
        const std::optional<Hit> hit = scene.intersect(way.last);
        if (medium.id != vacuum) {
            way.transmittance *= estimate_transmittance(scene.medium(medium.id), way.last,
                                                        hit ? hit->distance : longest_segment, random);
        }
        if (!(max_value(way.transmittance) > least_transmittance)) {
            return way;
        }
        if (!hit || hit->light >= 0) {
            way.end = hit ? Refracted::End::light : Refracted::End::nothing;
            return way;
        }
        if (scene.is_interface(*hit)) {
            medium = scene.medium_beyond(*hit, way.last.direction, medium);
            way.last.pass(*hit);
        } else {
            const auto* dielectric = std::get_if<DielectricMaterial>(&scene.material(*hit));
            const auto refracted =
                dielectric ? refract(-way.last.direction, hit->normal, dielectric->ior) : std::nullopt;
            if (!refracted || way.crossings == most_crossings) {
                return way;
            }
            ++way.crossings;
            way.transmittance *= 1 - fresnel_dielectric(-dot(way.last.direction, hit->normal), dielectric->ior);
            medium = scene.medium_beyond(*hit, refracted->direction, medium);
            way.last = way.last.leave(*hit, refracted->direction);
        }
    }
    return way;
}

}  // namespace

std::optional<Glimpse> glimpse(const Scene& scene, const Ray& ray, float distance, const MediumState& medium,
                               Pcg32& random) {
    constexpr int most_tries = 6;
    const bool is_far = distance == infinity;
    const Vec3 target = is_far ? ray.direction : ray.at(distance);
    Vec3 direction = ray.direction;
    for (int i = 0; i < most_tries; ++i) {
        const Refracted way = follow(scene, {ray.origin, direction}, medium, random);
        if (way.crossings == 0) {
            return std::nullopt;
        }
        const bool found = is_far ? way.end == Refracted::End::nothing && dot(way.last.direction, target) > close_enough
                                  : way.end == Refracted::End::light;
        if (found) {
            return Glimpse{direction, way.transmittance};
        }
        if (is_far) {
            direction = normalize(direction + target - way.last.direction);
        } else {
            const Vec3 rest = target - way.last.origin;
            const float along = dot(rest, way.last.direction);
            direction = normalize(direction * distance + rest - way.last.direction * along);
        }
    }
    return std::nullopt;
}

}  // namespace wend
