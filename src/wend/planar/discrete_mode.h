// Case's discrete mode with its angular shape: what light in a homogeneous medium tends to far from boundaries.
#pragma once

#include <span>
#include <vector>

namespace wend {

/// Seen from height h (mean free paths) along a direction whose cosine to the upward normal is mu, radiance grows as
/// exp(k h) I(mu), I(mu) = albedo S(mu) / (1 - k mu), and what is scattered of it to a walk that arrives along mu as
/// exp(k h) S(mu): I convolved with the phase function (case1967).
struct DiscreteMode {
    double k = 0;
    double albedo = 1;
    /// Coefficients of Legendre's polynomials in S(mu); the first is 1.
    std::vector<double> source{1};
};

/// The mode for an albedo in (0, 1] and a phase function by its Legendre moments (1, mean cosine, ...), each of size
/// below 1 but the first; those not listed are 0. S is accurate to 1e-7 of its mean.
DiscreteMode discrete_mode(double albedo, std::span<const double> moments);

}  // namespace wend
