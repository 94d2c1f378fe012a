// Planar decisions in three dimensions.
#pragma once

#include <wend/core/vector.h>
#include <wend/medium/averaged_phase.h>
#include <wend/planar/decisions.h>

#include <algorithm>
#include <cmath>

namespace wend {

/// A direction in space; `density_ratio` is its density over the phase function's.
struct SpatialDirection {
    Vec3 direction;
    double density_ratio = 1;
};

/// Draws a direction after a collision whose cosine to `inward`, the normal that points deeper, is the planar
/// decision's, and whose azimuth is that of Henyey and Greenstein's phase function given both cosines. So the density
/// per steradian is the density ratio of the cosine times the phase function: with the radiance of the decision's
/// adjoint, in proportion to phase function times radiance in three dimensions.
template <PlanarDirectionDecision D>
SpatialDirection sample_in_space(const D& decision, double g, double depth, const Vec3& before, const Vec3& inward,
                                 Pcg32& random) {
    const double mu = std::clamp(static_cast<double>(dot(before, inward)), -1.0, 1.0);
    const PlanarDirection drawn = decision.sample(depth, mu, random);
    const double azimuth = sample_azimuth(g, mu, drawn.cosine, random);
    // The horizontal part of the direction before; any, where it has none.
    const Vec3 horizontal = before - inward * dot(before, inward);
    const Vec3 ahead = length_squared(horizontal) > 1e-12f ? normalize(horizontal) : Frame::from_z(inward).s;
    const auto sine = static_cast<float>(std::sqrt(std::max(0.0, 1 - drawn.cosine * drawn.cosine)));
    const Vec3 direction = inward * static_cast<float>(drawn.cosine) +
                           ahead * (sine * static_cast<float>(std::cos(azimuth))) +
                           cross(inward, ahead) * (sine * static_cast<float>(std::sin(azimuth)));
    return {normalize(direction), drawn.density_ratio};
}

/// The density ratio of a direction, drawn or not.
template <PlanarDirectionDecision D>
double density_ratio_in_space(const D& decision, double depth, const Vec3& before, const Vec3& after,
                              const Vec3& inward) {
    return decision.density_ratio(depth, std::clamp(static_cast<double>(dot(before, inward)), -1.0, 1.0),
                                  std::clamp(static_cast<double>(dot(after, inward)), -1.0, 1.0));
}

}  // namespace wend
