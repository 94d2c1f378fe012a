#include <wend/transport/first_surface.h>

#include <wend/light/next_event.h>
#include <wend/light/scattering.h>
#include <wend/medium/transmittance.h>

#include <optional>

namespace wend {
namespace {

void add(SeenObjects& objects, std::uint32_t id, float part) {
    if (part > 0) {
        objects.parts.push_back({id, part});
    }
}

}  // namespace

FilmFeatures first_surface(const Scene& scene, const Ray& camera_ray, Pcg32& random, SeenObjects* objects) {
    constexpr int most_specular = 16;
    FilmFeatures seen;
    TracedRay ray(camera_ray);
    MediumState medium = scene.medium_around(camera_ray);
    Rgb passed(1.0f), weight(1.0f);
    int specular = 0;
    for (int met = 0; met < most_interfaces; ++met) {
        const bool is_straight = specular == 0;
        const std::optional<Hit> hit = scene.intersect(ray);
        if (is_straight && medium.id != vacuum) {
            const float length = hit ? hit->distance : longest_segment;
            const float before = mean_value(passed);
            passed *= estimate_transmittance(scene.medium(medium.id), ray, length, random);
            if (objects) {
                add(*objects, objects->ids.of_media[static_cast<std::size_t>(medium.id)], before - mean_value(passed));
            }
        }
        if (!hit) {
            // Behind a mirror that shows nothing but the sky there is the mirror.
            seen.depth = is_straight ? 0 : seen.depth;
            break;
        }
        seen.depth += is_straight ? hit->distance : 0;
        if (is_straight && hit->surface->view == CameraView::held_out) {
            seen.depth = 0;
            break;
        }
        if (is_straight && hit->surface->view == CameraView::hidden) {
            ray.pass(*hit);
            continue;
        }
        if (scene.is_interface(*hit)) {
            medium = scene.medium_beyond(*hit, ray.direction, medium);
            ray.pass(*hit);
            continue;
        }
        seen.alpha = 1;
        if (is_straight) {
            seen.position = hit->position;
            seen.face_normal = hit->normal;
            if (objects) {
                add(*objects, objects->ids.of_surfaces[scene.surface_index(*hit)], mean_value(passed));
            }
        }
        const SurfaceScattering f(scene, *hit, ray.direction);
        std::optional<DirectionSample> s;
        if (f.is_specular() && specular++ < most_specular) {
            const float u = random.uniform();
            s = f.sample(u, random.uniform2());
        }
        if (!s || !s->specular) {
            seen.albedo = weight * f.albedo();
            seen.normal = hit->shading.n;
            break;
        }
        weight *= s->weight();
        medium = scene.medium_beyond(*hit, s->direction, medium);
        ray = ray.leave(*hit, s->direction);
    }
    seen.opacity = 1 - mean_value(passed);
    if (seen.alpha == 0) {
        seen.alpha = seen.opacity;
    }
    return seen;
}

}  // namespace wend
