#include <wend/scene/scene.h>
#include <wend/scene/traced_ray.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// A ray that is more along the surface does not get behind it.
constexpr float least_cosine = 1.0f / 32;

bool is_on_sphere(const Surface& surface) {
    const auto* quadric = std::get_if<Quadric>(&surface.shape);
    return quadric && std::holds_alternative<Sphere>(quadric->shape);
}

}  // namespace

TracedRay TracedRay::leave(const Hit& hit, const Vec3& w) const {
    TracedRay ray(hit, w, (dot(direction, hit.normal) < 0) != (dot(w, hit.normal) < 0));
    // What was left in the same place, a moment ago, still lies there.
    if (hit.t < zone_) {
        ray.left_[1] = left_[0];
        ray.left_[2] = left_[1];
    }
    return ray;
}

TracedRay::TracedRay(const Hit& hit, const Vec3& w, bool reflected) : reflected_(reflected) {
    const float cosine = dot(w, hit.normal);
    const bool along = (cosine > 0) != hit.against_winding;
    const float behind = 2 * hit.clearance / std::max(std::abs(cosine), least_cosine);
    start_ = hit.position + hit.normal * (cosine > 0 ? hit.clearance : -hit.clearance) - w * behind;
    origin = start_;
    direction = w;
    own_ = hit.element;
    own_again_ = !along && is_on_sphere(*hit.surface);
    zone_ = 2 * behind;
    left_[0] = {hit.element.surface, hit.element.instance, along, reflected};
}

}  // namespace wend
