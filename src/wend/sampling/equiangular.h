// Distances along a ray towards a light beside it.
#pragma once

#include <wend/core/ray.h>

#include <algorithm>
#include <cmath>

namespace wend {

/// Distances from t_in to t_out along a ray, drawn by the angle under which a light sees them (kulla2012): with density
/// in proportion to 1 / r², r the distance to the light. A light that is no point is one that the ray passes by further
/// away.
class Equiangular {
public:
    /// `extent_squared`: the mean of the squared distances of the light's parts from `light`, not negative.
    /// 0 <= t_in < t_out, which may be infinite; the direction of the ray is a unit vector.
    Equiangular(const Ray& ray, const Vec3& light, float extent_squared, float t_in, float t_out)
        : t_in_(t_in), t_out_(std::min(t_out, farthest)) {
        const Vec3 towards = light - ray.origin;
        closest_ = dot(towards, ray.direction);
        // What passes closer than this cannot be told from a hit.
        constexpr float least = 1e-8f;
        distance_ = std::sqrt(length_squared(towards - ray.direction * closest_) + extent_squared +
                              least * length_squared(towards) + 1e-30f);
        const float before = t_in_ - closest_, behind = t_out_ - closest_;
        angle_ = std::atan2(distance_ * (t_out_ - t_in_), sqr(distance_) + before * behind);
    }

    /// `u` in [0,1).
    float sample(float u) const {
        const float begin = std::atan((t_in_ - closest_) / distance_);
        return std::clamp(closest_ + distance_ * std::tan(begin + u * angle_), t_in_, t_out_);
    }
    /// 0 outside of the interval.
    float density(float t) const {
        const float square = sqr(distance_) + sqr(t - closest_);
        return t >= t_in_ && t <= t_out_ && angle_ > 0 ? distance_ / (angle_ * square) : 0.0f;
    }
    /// ∫ dt / r² over the interval.
    float integral() const { return angle_ / distance_; }
    /// Where the light is closest in the interval.
    float closest() const { return std::clamp(closest_, t_in_, t_out_); }
    /// The cosine of the ray to the light's direction in the middle of the angle.
    float cosine() const {
        const float before = t_in_ - closest_, behind = t_out_ - closest_;
        const float a = 1 / std::sqrt(sqr(distance_) + sqr(before)), b = 1 / std::sqrt(sqr(distance_) + sqr(behind));
        const float along = a * before + b * behind, across = distance_ * (a + b);
        return -along / std::sqrt(sqr(along) + sqr(across));
    }

private:
    /// Its square is a number.
    static constexpr float farthest = 1e15f;

    float t_in_, t_out_;
    float closest_, distance_;
    float angle_;
};

}  // namespace wend
