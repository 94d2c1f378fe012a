// What the decisions of a walk ask of an adjoint, whether learned or computed.
#pragma once

#include <wend/core/vector.h>
#include <wend/sampling/vmf.h>

#include <concepts>

namespace wend {

/// Incident radiance at a point as a distribution of directions (pointing to where the radiance comes from): normalized
/// to 1 over the sphere, so that the scale is asked for apart. It can be multiplied with a lobe standing for a phase
/// function or a BSDF, which gives a distribution of the same type and the integral of the product, in 1/sr.
template <class T>
concept IncidentRadiance = requires(const T& radiance, Vec2 u, const Vec3& direction, const Vmf& lobe) {
    { radiance.sample(u) } -> std::same_as<Vec3>;
    { radiance.density(direction) } -> std::same_as<float>;
    { radiance.product(lobe).distribution } -> std::convertible_to<T>;
    { radiance.product(lobe).integral } -> std::convertible_to<float>;
};

/// An estimate of the radiance that a walk would still collect around a point.
///  - incident(x): the distribution of the incident radiance at x;
///  - fluence(): its scale, ∫ L dω, in radiance times sr.
/// The in-scattered radiance for a lobe f is therefore fluence() · incident(x).product(f).integral, and the expected
/// contribution of a continuation with that lobe is the same number times the albedo.
template <class T>
concept Adjoint = requires(const T& adjoint, const Vec3& position) {
    { adjoint.incident(position) } -> IncidentRadiance;
    { adjoint.fluence() } -> std::convertible_to<float>;
};

/// In-scattered radiance at a point for one lobe, ∫ f(ω) L(x, ω) dω.
template <Adjoint A>
float in_scattered(const A& adjoint, const Vec3& position, const Vmf& lobe) {
    return adjoint.fluence() * adjoint.incident(position).product(lobe).integral;
}

}  // namespace wend
