// What scatters at a collision.
#pragma once

#include <wend/decision/direction.h>
#include <wend/medium/phase.h>

namespace wend {

/// A phase function, which must outlive it, given the direction of propagation before the collision.
class VolumeScattering {
public:
    static constexpr bool in_volume = true;

    VolumeScattering(const PhaseFunction& phase, const Vec3& before) : phase_(phase), before_(before) {}

    Rgb evaluate(const Vec3& w) const { return Rgb(density(w)); }
    float density(const Vec3& w) const { return phase_.evaluate(dot(before_, w)); }
    std::optional<DirectionSample> sample(float, const Vec2& u2) const {
        const Vec3 w = phase_.sample(before_, u2);
        const float p = density(w);
        return DirectionSample{w, Rgb(p), p};
    }
    AxialLobes lobes() const { return phase_.lobes(before_); }
    bool is_specular() const { return false; }
    /// The guide has no picture of what is still more peaked.
    bool is_guidable() const { return std::abs(phase_.mean_cosine()) <= largest_pictured_g; }
    /// The direction of propagation before the collision.
    const Vec3& before() const { return before_; }
    float index_ratio(const Vec3&) const { return 1; }
    /// Absorption is the flight's matter.
    Rgb albedo() const { return Rgb(1.0f); }

private:
    const PhaseFunction& phase_;
    Vec3 before_;
};

static_assert(ScatteringFunction<VolumeScattering>);

}  // namespace wend
