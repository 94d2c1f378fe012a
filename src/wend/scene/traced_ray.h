// Rays that know what they have met: what touches is told apart by what it is, not by where it is.
#pragma once

#include <wend/core/vector.h>

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
    /// Whether both are parts of one surface in one place.
    bool is_of_the_same(const SurfaceElement& o) const { return surface == o.surface && instance == o.instance; }
};

/// A ray through the scene, from where it has come to (the base class) onwards. It passes an interface by going on
/// along the same line: what was found is not found again, and what lies in the same place is.
///
/// From a surface it starts a little way behind the point, and from the point on it is clear of the surface by as much
/// as rounding may be. Of what lies within that little way a ray that goes through the surface does not meet again what
/// was crossed on the way there; a ray that is reflected meets that alone, and the other way round.
class TracedRay : public Ray {
public:
    TracedRay() = default;
    /// From a place in the open.
    TracedRay(const Ray& ray) : Ray(ray), start_(ray.origin) {}
    TracedRay(const Vec3& from, const Vec3& along) : TracedRay(Ray{from, along}) {}

    /// Past what this ray has met.
    void pass(const Hit& met);

    /// From a surface that this ray has met, in direction w.
    TracedRay leave(const Hit& hit, const Vec3& w) const;
    /// From a surface in direction w, with nothing in the same place.
    static TracedRay leave_anew(const Hit& hit, const Vec3& w) { return TracedRay(hit, w, true); }

    /// Turns the ray, before it has met anything, so that it goes through a point far from where it starts; returns the
    /// distance of that.
    float aim_at(const Vec3& point) {
        const Vec3 way = point - start_;
        const float distance = length(way);
        direction = way * (1 / distance);
        return distance;
    }

    /// By how much the ray starts elsewhere for a primitive of a curve that has so many, so that it is outside of the
    /// curve that it leaves.
    Vec3 offset_for(const SurfaceElement& met, std::uint32_t pieces) const {
        const bool is_near = met.primitive + pieces >= own_.primitive && met.primitive <= own_.primitive + pieces;
        return leaves_curve_ && met.is_of_the_same(own_) && is_near ? curve_offset_ : Vec3(0, 0, 0);
    }

    /// Where the ray is traced from, and how far along it has come.
    const Vec3& start() const { return start_; }
    float passed() const { return passed_; }

    /// Whether what is met at distance t from start() is still ahead. `along`: whether the normal by the surface's
    /// winding is along the ray.
    bool is_ahead(const SurfaceElement& met, float t, bool along) const {
        if (t < passed_ || (met == own_ && !(own_again_ && along) && !leaves_curve_)) {
            return false;
        }
        if (t == passed_ && has_crossing([&](std::size_t i) { return t_[i] == t && met_[i] == met; })) {
            return false;
        }
        if (t > zone_) {
            return true;
        }
        if (reflected_ && met.is_of_the_same(own_) && !leaves_curve_) {
            return false;
        }
        const bool was_crossed = has_crossing([&](std::size_t i) {
            return t_[i] == before && met_[i].is_of_the_same(met) && along_[i] == (along != reflected_);
        });
        return was_crossed == reflected_;
    }

private:
    static constexpr std::size_t most = 4;
    static constexpr float before = -1;

    TracedRay(const Hit& hit, const Vec3& w, bool reflected);

    void add(const SurfaceElement& met, float t, bool along);
    template <class Is>
    bool has_crossing(const Is& is) const {
        for (std::size_t i = 0; i < count_; ++i) {
            if (is(i)) {
                return true;
            }
        }
        return false;
    }

    Vec3 start_{0, 0, 0};
    float passed_ = 0;
    /// Up to where lies what may be in the place that it starts from.
    float zone_ = 0;
    /// What it starts on.
    SurfaceElement own_{};
    /// The last crossings of surfaces, and those of the ray before in the same place, the latest first. Paths keep
    /// rays, so that there is no padding within.
    std::array<SurfaceElement, most> met_{};
    std::array<float, most> t_{};  ///< from start(), or `before`
    std::array<bool, most> along_{};
    std::uint8_t count_ = 0;
    bool reflected_ = false;
    /// Whether it may meet what it starts on again along its normal, as from within a sphere.
    bool own_again_ = false;
    /// Whether that is a curve; then how far outside of it the ray starts.
    bool leaves_curve_ = false;
    Vec3 curve_offset_{0, 0, 0};
};

}  // namespace wend
