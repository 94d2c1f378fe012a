#include <wend/scene/traced_ray.h>

#include <wend/scene/scene.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// A ray that is more along the surface does not get behind it.
constexpr float least_cosine = 1.0f / 32;

/// What a distance may be off by, over itself: as large as that of surface_point.cpp.
constexpr float rounding = 1e-6f;

/// Whether a ray that starts inwards may meet the same element again, on its way out.
bool is_round(const Surface& surface) {
    const auto* quadric = std::get_if<Quadric>(surface.shape.get());
    return std::holds_alternative<CylinderShell>(*surface.shape) ||
           (quadric && std::holds_alternative<Sphere>(quadric->shape));
}

/// Whether the normal by the surface's winding is along w.
bool is_along(const Hit& hit, const Vec3& w) {
    return (dot(w, hit.normal) > 0) != hit.against_winding;
}

}  // namespace

void TracedRay::add(const SurfaceElement& met, float t, bool along) {
    const auto put_first = [](auto& list, const auto& value) {
        std::move_backward(list.begin(), list.end() - 1, list.end());
        list[0] = value;
    };
    put_first(met_, met);
    put_first(t_, t);
    put_first(along_, along);
    count_ = static_cast<std::uint8_t>(std::min(count_ + std::size_t{1}, most));
}

void TracedRay::pass(const Hit& met) {
    passed_ = met.t;
    origin = start_ + direction * passed_;
    add(met.element, met.t, is_along(met, direction));
}

TracedRay TracedRay::leave(const Hit& hit, const Vec3& w) const {
    TracedRay ray(hit, w, (dot(direction, hit.normal) < 0) != (dot(w, hit.normal) < 0));
    const bool along = ray.along_[0];
    // Near the origin the place is known better than the way there was. What is farther than the ray's own zone will be
    // met as anything else is.
    const float reach = ray.zone_ + rounding * hit.t;
    ray.count_ = 0;
    for (std::size_t i = count_; i-- > 0;) {
        const bool is_here = t_[i] == before ? hit.t < zone_ : hit.t - t_[i] <= reach;
        if (is_here) {
            ray.add(met_[i], before, along_[i]);
        }
    }
    ray.add(hit.element, before, along);
    return ray;
}

TracedRay::TracedRay(const Hit& hit, const Vec3& w, bool reflected) : reflected_(reflected) {
    const float cosine = dot(w, hit.normal);
    const bool along = is_along(hit, w);
    const float behind = 2 * hit.clearance / std::max(std::abs(cosine), least_cosine);
    start_ = hit.position + hit.normal * (cosine > 0 ? hit.clearance : -hit.clearance) - w * behind;
    origin = start_;
    direction = w;
    time = hit.time;
    own_ = hit.element;
    own_again_ = !along && is_round(*hit.surface);
    zone_ = 2 * behind;
    if (std::holds_alternative<CurveSet>(*hit.surface->shape)) {
        leaves_curve_ = true;
        curve_offset_ = hit.normal * (cosine > 0 ? hit.thickness : -hit.thickness);
    }
    add(hit.element, before, along);
}

}  // namespace wend
