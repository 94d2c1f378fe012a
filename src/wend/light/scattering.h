// What scatters at a walk's vertices, as decision/direction.h wants it: one argument, the direction of propagation.
#pragma once

#include <wend/core/vector.h>
#include <wend/decision/direction.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/scene.h>

#include <algorithm>

namespace wend {

/// A BSDF at a surface, given the direction of propagation before the hit.
class SurfaceScattering {
public:
    static constexpr bool in_volume = false;

    SurfaceScattering(Bsdf bsdf, const Frame& shading, const Vec3& before)
        : bsdf_(std::move(bsdf)), shading_(shading), wo_(shading.to_local(-before)) {}
    SurfaceScattering(const Scene& scene, const Hit& hit, const Vec3& before)
        : bsdf_(scene.bsdf(hit, &count_)), shading_(hit.shading), wo_(shading_.to_local(-before)) {}

    Rgb evaluate(const Vec3& w) const {
        return count_ * std::visit([&](const auto& b) { return b.evaluate(wo_, shading_.to_local(w)); }, bsdf_);
    }
    float density(const Vec3& w) const {
        return std::visit([&](const auto& b) { return b.density(wo_, shading_.to_local(w)); }, bsdf_);
    }
    std::optional<DirectionSample> sample(float u, const Vec2& u2) const {
        const auto s = std::visit([&](const auto& b) { return b.sample(wo_, u, u2); }, bsdf_);
        if (!s) {
            return std::nullopt;
        }
        return DirectionSample{shading_.to_world(s->direction), count_ * s->value, s->density, s->specular,
                               s->density_ratio};
    }
    AxialLobes lobes() const {
        const AxialLobes local = lobes_of(bsdf_, wo_);
        return local.around(shading_.to_world(local.axis()));
    }
    bool is_specular() const {
        return std::visit([](const auto& b) { return b.is_specular(); }, bsdf_);
    }
    /// Whether light goes on either side, as Fresnel's equations have it.
    bool reflects_or_refracts() const { return std::holds_alternative<DielectricBsdf>(bsdf_); }
    /// Draws reflections so many times more often (DielectricBsdf::odds), the less so the more a walk weighs.
    void prefer_reflection(float odds, float weight = 0) {
        DielectricBsdf& boundary = std::get<DielectricBsdf>(bsdf_);
        boundary.odds = odds;
        boundary.fresnel_share = std::max(boundary.fresnel_share, least_defensive_fraction(weight));
    }
    bool is_guidable() const { return is_pictured_by_lobes(bsdf_); }
    float index_ratio(const Vec3& w) const { return wend::index_ratio(bsdf_, wo_, shading_.to_local(w)); }
    Rgb albedo() const { return count_ * directional_albedo(bsdf_, wo_); }

private:
    float count_ = 1;  ///< of the BSDF; it stands before that, which sets it
    Bsdf bsdf_;
    Frame shading_;
    Vec3 wo_;
};

static_assert(ScatteringFunction<SurfaceScattering>);

}  // namespace wend
