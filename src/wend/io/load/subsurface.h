#pragma once

namespace wend {

/// Single-scattering albedo in [0,1] of a half-space that reflects the share `reflectance` (clamped to [0,1]) of
/// diffuse light, where the phase function has the mean cosine g in (-1,1) and the boundary does not reflect: the fit
/// of kulla2017, whose half-spaces reflect what is asked to within 0.0025 for g = 0.
float albedo_of_reflectance(float reflectance, float g);

}  // namespace wend
