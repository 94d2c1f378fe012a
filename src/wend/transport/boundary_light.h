// The light that arrives at the boundary of a dense medium, and what the medium looks like from there.
#pragma once

#include <wend/scene/boundary_points.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/scene.h>
#include <wend/subsurface/interior_walk.h>

#include <span>
#include <vector>

namespace wend {

/// A point of the boundary with what a walk inside wants to know of it.
struct LitPoint {
    BoundaryPoint point;
    float curvature = 0;   ///< of the boundary, its mean (mean_curvatures)
    float irradiance = 0;  ///< of light from outside, directly or reflected once
    /// Lights outside that walks may run into, or be connected to at the boundary; the strongest come first.
    std::array<BoundaryEmitter, EmitterGuide::most> lamps{};
    int emitter_count = 0;
};

/// How the boundary refracts, taken to be the same all over.
struct BoundarySurface {
    float ior = 1;    ///< of the inside over the outside
    float alpha = 0;  ///< roughness of the microfacets

    DielectricBsdf bsdf() const { return {ior, alpha, alpha}; }
};

/// Points with the irradiance by lights outside and by what reflects it, as a scalar. Where a point sees a medium or a
/// boundary that refracts, from where more may come, a little is added; else it may be next to nothing.
std::vector<LitPoint> lit_points(const Scene& scene, std::span<const BoundaryPoint> points,
                                 const BoundarySurface& boundary, int samples, Pcg32& random);

/// The mean length of chords through the object, 4 volume / area, by rays inwards from its boundary. Those that leave
/// an open object count as its diameter.
float mean_chord(const Scene& scene, MediumId medium, std::span<const BoundaryPoint> points, Pcg32& random);

}  // namespace wend
