// Rays that know what they have met: what touches is told apart by what it is, not by where it is.
#pragma once

#include <wend/core/ray.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace wend {

struct Hit;

/// One primitive of a surface, where it is placed.
struct SurfaceElement {
    std::uint32_t surface = ~0u;
    std::uint32_t primitive = 0;
    std::int32_t instance = -1;  ///< -1: not an instance

    friend bool operator==(const SurfaceElement&, const SurfaceElement&) = default;
};

/// A ray through the scene, from where it has come to (the base class) onwards. It passes an interface by going on
/// along the same line: what was found is not found again, and what lies in the same place is. From a surface it starts
/// a little way behind the point, on the far side of what may touch there, and does not meet again what was crossed or
/// left there in the same sense. From the point on it is clear of the surface by as much as rounding may be.
class TracedRay : public Ray {
public:
    TracedRay() = default;
    /// From a place in the open.
    TracedRay(const Ray& ray) : Ray(ray), start_(ray.origin) {}

    /// Past what this ray has met at distance t from start().
    void pass(const SurfaceElement& met, float t) {
        // Of what lies at the same distance any may be found first.
        met_count_ = t == passed_ ? met_count_ : 0;
        passed_ = t;
        origin = start_ + direction * t;
        met_[met_count_ % met_.size()] = met;
        ++met_count_;
    }

    /// From a surface that this ray has met, in direction w.
    TracedRay leave(const Hit& hit, const Vec3& w) const;
    /// From a surface in direction w, where it does not matter how it was reached.
    static TracedRay leave_anew(const Hit& hit, const Vec3& w) { return TracedRay(hit, w, true); }

    /// Where the ray is traced from, and how far along it has come.
    const Vec3& start() const { return start_; }
    float passed() const { return passed_; }

    /// Whether what is met at distance t from start() is still ahead. `along`: whether the normal by the surface's
    /// winding is along the ray; `passable`: whether rays can go on behind it.
    bool is_ahead(const SurfaceElement& met, float t, bool along, bool passable) const {
        if (t < passed_ || (met == own_ && !(own_again_ && along))) {
            return false;
        }
        if (t == passed_) {
            const std::size_t count = std::min<std::size_t>(met_count_, met_.size());
            if (std::find(met_.begin(), met_.begin() + count, met) != met_.begin() + count) {
                return false;
            }
        }
        if (t >= zone_) {
            return true;
        }
        for (const Left& left : left_) {
            if (left.surface == met.surface && left.instance == met.instance &&
                (left.along == along || left.reflected)) {
                return false;
            }
        }
        // A reflected ray starts behind its surface: what does not let it through there is in the dark.
        return passable || !reflected_;
    }

private:
    static constexpr std::uint32_t none = ~0u;

    TracedRay(const Hit& hit, const Vec3& w, bool reflected);

    struct Left {
        std::uint32_t surface = none;
        std::int32_t instance = -1;
        bool along = false;
        bool reflected = false;  ///< neither way round will it be met
    };

    Vec3 start_{0, 0, 0};
    float passed_ = 0;
    /// The last that were passed at that distance.
    std::array<SurfaceElement, 4> met_{};
    std::uint32_t met_count_ = 0;
    /// What it starts on, and whether it may meet that again along its normal, as from within a sphere.
    SurfaceElement own_{};
    bool own_again_ = false;
    /// Up to where the ray may meet what it has left.
    float zone_ = 0;
    bool reflected_ = false;
    std::array<Left, 3> left_{};
};

}  // namespace wend
