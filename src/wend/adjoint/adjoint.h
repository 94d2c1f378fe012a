// What the decisions of a walk ask of an adjoint, whether learned or computed.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>
#include <wend/sampling/axial_lobes.h>

#include <concepts>

namespace wend {

/// A density over directions, normalized to 1 over the sphere, that can be drawn from.
template <class T>
concept DirectionDistribution = requires(const T& distribution, Vec2 u, const Vec3& direction) {
    { distribution.sample(u) } -> std::same_as<Vec3>;
    { distribution.density(direction) } -> std::same_as<float>;
};

/// Incident radiance at a point as a distribution of directions (pointing to where the radiance comes from), so that
/// the scale is asked for apart. Its product with the lobes that stand for a phase function or a BSDF is a distribution
/// too, and knows the integral of the product, in 1/sr.
template <class T>
concept IncidentRadiance = requires(const T& radiance, const AxialLobes& lobes) {
    requires DirectionDistribution<T>;
    { radiance.product(lobes) } -> DirectionDistribution;
    { radiance.product(lobes).integral() } -> std::same_as<float>;
};

/// An estimate of the radiance that a walk would still collect around a point.
///  - incident(x): the distribution of the incident radiance at x;
///  - fluence(): its scale, ∫ L dω, in radiance times sr;
///  - in_scattered(product): ∫ f L dω by colour channel, for a product of the incident radiance with the lobes of f;
///  - defensive_fraction(): how far its directions are to be trusted, as the share in (0,1] that sampling the
///  scattering
///    function alone should keep beside them.
/// The mean of the channels of in_scattered(product) is fluence() · product.integral(). The expected contribution of a
/// continuation is the in-scattered radiance times throughput and albedo, channel by channel.
template <class T>
concept Adjoint = requires(const T& adjoint, const Vec3& position, const AxialLobes& lobes) {
    { adjoint.incident(position) } -> IncidentRadiance;
    { adjoint.fluence() } -> std::convertible_to<float>;
    { adjoint.in_scattered(adjoint.incident(position).product(lobes)) } -> std::same_as<Rgb>;
    { adjoint.defensive_fraction() } -> std::convertible_to<float>;
};

/// In-scattered radiance at a point, ∫ f(ω) L(x, ω) dω, for the lobes of f.
template <Adjoint A>
Rgb in_scattered(const A& adjoint, const Vec3& position, const AxialLobes& lobes) {
    return adjoint.in_scattered(adjoint.incident(position).product(lobes));
}

}  // namespace wend
