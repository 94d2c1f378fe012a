// Distances along a ray towards a light beside it.
#pragma once

#include <wend/core/ray.h>

#include <algorithm>
#include <cmath>

namespace wend {

/// How a ray passes a light by. A light that is no point is one that it passes by further away.
class ClosestApproach {
public:
    /// `extent_squared`: the mean of the squared distances of the light's parts from `light`, not negative. The
    /// direction of the ray is a unit vector.
    ClosestApproach(const Ray& ray, const Vec3& light, float extent_squared) {
        const Vec3 towards = light - ray.origin;
        along_ = dot(towards, ray.direction);
        // What passes closer than this cannot be told from a hit.
        constexpr float least = 1e-8f;
        beside_squared_ = length_squared(towards - ray.direction * along_) + extent_squared +
                          least * length_squared(towards) + 1e-30f;
    }

    /// Where along the ray the light is closest, before its origin if negative, and how far away it is there.
    float along() const { return along_; }
    /// How far away that is.
    float beside() const { return std::sqrt(beside_squared_); }
    /// The squared distance of the light.
    float squared_distance(float t) const { return beside_squared_ + sqr(t - along_); }
    /// The cosine of the ray to the light's direction.
    float cosine(float t) const { return (along_ - t) / std::sqrt(squared_distance(t)); }

    /// Whether the light is no more than twice as far from one place between t_in and t_out as from another.
    bool is_about_as_far(float t_in, float t_out) const {
        const float farthest = std::max(squared_distance(t_in), squared_distance(t_out));
        return farthest <= 4 * squared_distance(std::clamp(along_, t_in, t_out));
    }
    /// The mean of 1/r² there, by Simpson's rule.
    float mean_inverse_square(float t_in, float t_out) const {
        const float in = squared_distance(t_in), middle = squared_distance(0.5f * (t_in + t_out)),
                    out = squared_distance(t_out);
        return (1 / in + 4 / middle + 1 / out) / 6;
    }

private:
    float along_, beside_squared_;
};

/// Distances from t_in to t_out along a ray, drawn by the angle under which a light sees them (kulla2012): with density
/// in proportion to 1 / r², r the distance to the light.
class Equiangular {
public:
    /// 0 <= t_in < t_out, which may be infinite.
    Equiangular(const ClosestApproach& approach, float t_in, float t_out)
        : t_in_(t_in), t_out_(std::min(t_out, farthest)), closest_(approach.along()), distance_(approach.beside()) {
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
