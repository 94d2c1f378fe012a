// Lights behind glass: connections cannot reach them, but guides can be told where to look.
#pragma once

#include <wend/core/random.h>
#include <wend/scene/scene.h>

#include <optional>

namespace wend {

/// A light as it is seen through boundaries that refract.
struct Glimpse {
    /// From the place that sees it, unit length.
    Vec3 direction;
    /// What arrives of its radiance: Fresnel's transmittances, and an estimate of those of media.
    Rgb transmittance;
};

/// Looks for a light behind glass, first straight ahead, and by how far that misses it in a few more directions
/// (a fixed point of what hanika2015 solves by Newton's method). Nothing where the way is blocked, where no boundary
/// refracts, so that connections do as well, or where none of the directions ends at a light. It tells that light
/// arrives there, not how much: what is learned from it is for guides only. Rough boundaries are taken for smooth.
/// The ray starts in `medium` and heads for a light at `distance`, which may be infinite.
std::optional<Glimpse> glimpse(const Scene& scene, const Ray& ray, float distance, const MediumState& medium,
                               Pcg32& random);

}  // namespace wend
