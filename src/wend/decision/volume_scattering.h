// What scatters at a collision.
#pragma once

#include <wend/decision/direction.h>
#include <wend/medium/phase.h>

namespace wend {

/// A phase function, which must outlive it, given the direction of propagation before the collision.
class VolumeScattering {
public:
    /// The field of volumes is asked.
    static constexpr bool in_volume = true;

    /// `before` has unit length.
    VolumeScattering(const PhaseFunction& phase, const Vec3& before) : phase_(phase), before_(before) {}

    /// The phase function in a direction of propagation, in 1/sr; the same in all channels.
    Rgb evaluate(const Vec3& w) const { return Rgb(density(w)); }
    /// The same number: sample() is exact.
    float density(const Vec3& w) const { return phase_.evaluate(dot(before_, w)); }
    /// A direction in proportion to the phase function, from a point of [0,1)².
    std::optional<DirectionSample> sample(float, const Vec2& u2) const {
        const Vec3 w = phase_.sample(before_, u2);
        const float p = density(w);
        return DirectionSample{w, Rgb(p), p};
    }
    /// The phase function's picture around the direction before.
    AxialLobes lobes() const { return phase_.lobes(before_); }
    /// Never.
    bool is_specular() const { return false; }
    /// The guide has no picture of what is still more peaked.
    bool is_guidable() const { return std::abs(phase_.mean_cosine()) <= largest_pictured_g; }
    /// The direction of propagation before the collision.
    const Vec3& before() const { return before_; }
    /// A collision does not change the refractive index.
    float index_ratio(const Vec3&) const { return 1; }
    /// Absorption is the flight's matter.
    Rgb albedo() const { return Rgb(1.0f); }

private:
    const PhaseFunction& phase_;
    Vec3 before_;
};

static_assert(ScatteringFunction<VolumeScattering>);

}  // namespace wend
