// Henyey and Greenstein's phase function (henyey1941) in plane-parallel media: the cosine to the normal after a
// collision, averaged over azimuth, and the azimuth given both cosines. `mu` and `mu_new` are the cosines of the
// directions of propagation before and after the collision, in [-1, 1]; the mean cosine g is in [-0.99, 0.99].
#pragma once

#include <wend/core/random.h>

namespace wend {

/// The density of mu_new given mu: it integrates to 1 over [-1, 1].
double averaged_henyey_greenstein(double g, double mu, double mu_new);

/// The density at azimuth phi, the angle between the horizontal parts of both directions, given both cosines: it
/// integrates to 1 over a full turn.
double azimuth_density(double g, double mu, double mu_new, double phi);

/// Draws the azimuth phi in [-π, π] with azimuth_density(): a pair of numbers a trial, at most π/2 trials on average.
double sample_azimuth(double g, double mu, double mu_new, Pcg32& random);

}  // namespace wend
