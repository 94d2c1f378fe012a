// The exact interior of the half-space as a sum of decaying exponentials.
#pragma once

#include <vector>

namespace wend {

/// J(x) ≈ Σ coefficient[i] exp(-x / nu[i]), x in mean free paths. The discrete mode comes first.
struct CaseModes {
    std::vector<double> nu;
    std::vector<double> coefficient;
};

/// Case's modes (case1967) of J, the mean over all directions of the radiance seen from depth x in a half-space of
/// isotropic scattering and matched boundary under a uniform white sky of radiance 1: the discrete mode and
/// `transients` >= 0 nodes of the continuum nu in (0, 1), Gauss and Legendre's in t, nu = t² (3 - 2t). All coefficients
/// are positive, and their sum tends to J(0) = 1/(1 + sqrt(1 - albedo)) with the number of transients as its fourth
/// power. Albedo 1: nu = infinity alone, since J = 1. Albedo 0: no modes, since nothing is scattered.
CaseModes case_modes(double albedo, int transients);

}  // namespace wend
