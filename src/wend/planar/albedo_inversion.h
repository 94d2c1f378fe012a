// The albedo of a medium from the colour that it is to have.
#pragma once

#include <vector>

namespace wend {

/// Single-scattering albedos of half-spaces by how much of the light that has entered leaves them again: the question
/// of kulla2017, answered by discrete ordinates (stamnes1988) and so for any anisotropy, and for a boundary that
/// reflects light back inside.
class AlbedoInversion {
public:
    /// Henyey and Greenstein's mean cosine in (-1,1) and the refractive index inside over outside. Beyond ±0.95 the
    /// phase function is taken for a similar one, below an index of 1 the boundary for none, above 3 for one of 3. A
    /// rough boundary is taken for smooth.
    AlbedoInversion(double mean_cosine, double ior);

    /// The albedo in [0,1] of a half-space that, lit evenly from outside, returns the share `reflectance` (clamped to
    /// [0,1], NaN to 0) of what the boundary lets in; to within 0.001 of that share.
    float operator()(float reflectance) const;

private:
    double mean_cosine_;
    /// The root of 1 - albedo', where albedo' is that of the similar isotropic medium, at equal steps of reflectance:
    /// nearly linear where both are close to 1.
    std::vector<double> roots_;
};

}  // namespace wend
