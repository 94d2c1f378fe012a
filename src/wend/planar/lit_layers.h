// Layers of a medium in light, by thickness: what guides walks where a medium is thin.
#pragma once

#include <wend/planar/adjoint.h>

#include <vector>

namespace wend {

/// The adjoints of layers that are lit evenly at their near side, 1, 2, 4, 8 and 16 mean free paths thick, and last of
/// a half-space, by discrete ordinates of a few nodes (stamnes1988, docs/theory/planar.md), ready to be sampled. Albedo
/// in [0, 1]; Henyey and Greenstein's phase function; refractive index inside over outside, in [1, 3].
std::vector<PlanarAdjoint> lit_layers(double albedo, double mean_cosine, double ior);

}  // namespace wend
