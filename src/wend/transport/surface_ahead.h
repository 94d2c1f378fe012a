// The surface that a walk's flight may end at.
#pragma once

#include <wend/core/vector.h>
#include <wend/scene/scene.h>

#include <optional>

namespace wend {

/// The nearest surface along a ray. What it is like is asked where a walk gets there, or wants to know beforehand: most
/// flights through a dense medium do neither.
class SurfaceAhead {
public:
    /// Looks a little farther than the distance, so that what is behind it is behind it for sure.
    SurfaceAhead(const Scene& scene, const TracedRay& ray, float distance)
        : scene_(scene), ray_(ray), found_(scene.find(ray, distance * (1 + 1e-5f))) {}

    /// Whether there is one within the distance.
    explicit operator bool() const { return found_.has_value(); }
    /// To the surface, or `longest_segment`.
    float distance() const { return found_ ? found_->distance : longest_segment; }
    /// There must be one.
    const Hit& hit() {
        if (!hit_) {
            hit_ = scene_.complete(*found_, ray_);
        }
        return *hit_;
    }

private:
    const Scene& scene_;
    Ray ray_;
    std::optional<RayHit> found_;
    std::optional<Hit> hit_;
};

}  // namespace wend
