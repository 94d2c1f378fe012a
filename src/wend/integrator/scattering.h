// The scattering functions of a walk's vertices, as decision/direction.h wants them: one argument, the direction of
// propagation.
#pragma once

#include <wend/core/frame.h>
#include <wend/decision/direction.h>
#include <wend/medium/phase_lobes.h>
#include <wend/scene/bsdf/bsdf.h>

namespace wend {

/// A phase function, given the direction of propagation before the collision.
class VolumeScattering {
public:
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
    float index_ratio(const Vec3&) const { return 1; }
    /// Absorption is the flight's matter.
    Rgb albedo() const { return Rgb(1.0f); }

private:
    const PhaseFunction& phase_;
    Vec3 before_;
};

/// A BSDF at a surface, given the direction of propagation before the hit.
class SurfaceScattering {
public:
    SurfaceScattering(Bsdf bsdf, const Frame& shading, const Vec3& before)
        : bsdf_(std::move(bsdf)), shading_(shading), wo_(shading.to_local(-before)) {}

    Rgb evaluate(const Vec3& w) const {
        return std::visit([&](const auto& b) { return b.evaluate(wo_, shading_.to_local(w)); }, bsdf_);
    }
    float density(const Vec3& w) const {
        return std::visit([&](const auto& b) { return b.density(wo_, shading_.to_local(w)); }, bsdf_);
    }
    std::optional<DirectionSample> sample(float u, const Vec2& u2) const {
        const auto s = std::visit([&](const auto& b) { return b.sample(wo_, u, u2); }, bsdf_);
        if (!s) {
            return std::nullopt;
        }
        return DirectionSample{shading_.to_world(s->direction), s->value, s->density, s->specular};
    }
    AxialLobes lobes() const {
        const AxialLobes local = lobes_of(bsdf_, wo_);
        return local.around(shading_.to_world(local.axis()));
    }
    bool is_specular() const {
        return std::visit([](const auto& b) { return b.is_specular(); }, bsdf_);
    }
    bool is_guidable() const { return is_pictured_by_lobes(bsdf_); }
    float index_ratio(const Vec3& w) const { return wend::index_ratio(bsdf_, wo_, shading_.to_local(w)); }
    Rgb albedo() const { return directional_albedo(bsdf_, wo_); }

private:
    Bsdf bsdf_;
    Frame shading_;
    Vec3 wo_;
};

static_assert(ScatteringFunction<VolumeScattering> && ScatteringFunction<SurfaceScattering>);

}  // namespace wend
