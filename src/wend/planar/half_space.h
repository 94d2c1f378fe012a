// Exact answers for the half-space of isotropic scattering and matched boundary under a uniform white sky of radiance
// 1: what the walks of the lab are judged by. Lengths are mean free paths, albedos are in [0, 1], mu0 in [0, 1] is the
// cosine of the entering direction to the inward normal. A walk enters along mu0 and its value is the sky radiance it
// finds, so the mean is the reflectance for light that comes from there.
#pragma once

#include <wend/planar/eigenvalue.h>

namespace wend {

/// The part of a beam along mu0 that is reflected (chandrasekhar1960): 1 - sqrt(1 - albedo) H(mu0).
double reflectance(double albedo, double mu0);

/// The same for Lambertian incidence, where the beams' weights are 2 mu0 dmu0: the albedo seen in a white furnace.
double diffuse_reflectance(double albedo);

/// The same for incidence uniform in mu0.
double uniform_reflectance(double albedo);

/// Variance of a walk with classical distances and directions whose weight is multiplied by the albedo at each
/// collision.
double classical_variance(double albedo, double mu0);

/// How a walk of stretched paths flies from the entry to its first collision: by the medium's law, with rate 1 in the
/// optical distance, or stretched like all others, with rate 1 + mu0/nu.
enum class FirstFlight { classical, stretched };

/// Variance of a walk after Dwivedi (dwivedi1982): directions and distances for radiance that decays as exp(-x / nu),
/// nu the discrete eigenvalue.
double dwivedi_variance(double albedo, double mu0, FirstFlight first);

/// Second moment of such a walk made for any decay, in a medium of the given albedo. Squared weights multiply as in a
/// half-space of effective_albedo(), and beyond 1 the moment is infinite.
double stretched_second_moment(double albedo, const DiscreteEigenvalue& guide, double mu0, FirstFlight first);

/// albedo² nu atanh(1/nu) with the guide's nu; infinite for nu = 1. If nu is the eigenvalue of albedo a, this is
/// albedo²/a: at most 1 if and only if a >= albedo², so that no colour may be guided by one so much darker.
double effective_albedo(double albedo, const DiscreteEigenvalue& guide);

/// Milne's problem: a source at infinite depth, no incident radiance. Deep inside the fluence follows
/// sinh((x + distance) / nu), or x + distance without absorption; continued beyond the surface it vanishes at this
/// distance from it (case1967): 0.710446 for albedo 1, about that over the albedo otherwise. albedo > 0; relative error
/// below 1e-14 (1 + nu).
double extrapolation_distance(double albedo);

/// Moments over depth x of J, the mean over all directions of the radiance a walk sees from x: J is also the adjoint of
/// in-scattering.
struct FluenceMoments {
    double at_surface = 0;   ///< J(0)
    double integral = 0;     ///< ∫ J dx
    double mean_depth = 0;   ///< <x>, weighted by J
    double mean_square = 0;  ///< <x²>, weighted by J
};

/// Infinite but for at_surface if the albedo is 1, where J = 1 everywhere.
FluenceMoments fluence_moments(double albedo);

}  // namespace wend
