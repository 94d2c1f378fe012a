#include <wend/view/pixel_ray.h>

#include <wend/light/next_event.h>

namespace wend {

std::vector<RayPart> pixel_ray(const Scene& scene, const Vec2i& pixel) {
    const Vec2 middle(static_cast<float>(pixel.x) + 0.5f, static_cast<float>(pixel.y) + 0.5f);
    const Camera& camera = scene.camera();
    const CameraRay seen = camera.ray(middle, {0.5f, 0.5f}, camera.shutter().time(0.5f));
    std::vector<RayPart> parts;
    if (!(seen.weight > 0)) {
        return parts;
    }
    TracedRay ray(seen);
    MediumState medium = scene.medium_around(seen);
    Vec3 begin = seen.origin;
    for (int met = 0; met < most_interfaces; ++met) {
        const std::optional<Hit> hit = scene.intersect(ray);
        const bool passes = hit && scene.is_interface(*hit);
        parts.push_back({Ray{begin, seen.direction, seen.time}, medium.id, hit, passes});
        if (!passes) {
            break;
        }
        medium = scene.medium_beyond(*hit, ray.direction, medium);
        begin = hit->position;
        ray.pass(*hit);
    }
    return parts;
}

}  // namespace wend
