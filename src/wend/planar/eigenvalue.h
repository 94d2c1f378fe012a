// The discrete eigenvalue of Case's transport problem: how radiance decays deep inside a medium.
#pragma once

#include <span>

namespace wend {

/// Far from boundaries and sources radiance in a homogeneous medium follows exp(-x / nu), x in mean free paths, where
/// nu >= 1 is the largest root of the dispersion relation (case1967). Both 1/nu and its distance from 1 are kept, since
/// either may be tiny: nu - 1 is lost to rounding below an albedo of 0.05, though samplers divide by 1 - mu/nu.
struct DiscreteEigenvalue {
    double k = 1;    ///< 1/nu: 0 without absorption, 1 without scattering
    double gap = 0;  ///< 1 - 1/nu

    /// A decay of any other length nu in [1, infinity]: for guides that were made for another medium.
    static DiscreteEigenvalue of_length(double nu) { return {1 / nu, 1 - 1 / nu}; }

    /// Decay length in mean free paths; infinite without absorption.
    double nu() const { return 1 / k; }
};

/// Isotropic scattering, 1 = albedo nu atanh(1/nu), for an albedo in [0, 1]. The relative error of k, nu and gap is
/// below 1e-12. Below an albedo of 0.0028 the gap, about 2 exp(-2/albedo), is less than any double: it is 0, and nu
/// is 1.
DiscreteEigenvalue discrete_eigenvalue(double albedo);

/// Any phase function by its Legendre moments (1, mean cosine, ...; those not listed are 0), each of size below 1 but
/// the first, and an albedo in [0, 1]. The relative error of k and nu is below 1e-12, that of the gap times the gap
/// below 1e-15. Where no root exceeds 1, nu is 1: radiance then decays as its slowest transients do.
DiscreteEigenvalue discrete_eigenvalue(double albedo, std::span<const double> moments);

/// Henyey and Greenstein's phase function with mean cosine g, |g| <= 0.99.
DiscreteEigenvalue discrete_eigenvalue_henyey_greenstein(double albedo, double g);

}  // namespace wend
