// Plane-parallel transport by discrete ordinates: the radiance of a half-space or slab as a sum of exponential modes.
#pragma once

#include <wend/planar/adjoint.h>

#include <vector>

namespace wend {

struct PlanarProblem {
    double albedo = 0.8;  ///< in [0,1]
    /// Legendre moments of the phase function, the first being 1; the later ones, its mean P_l, are of size below 1. As
    /// many are used as the nodes can carry, two a node.
    std::vector<double> moments = {1};
    PlanarSlab slab;
    int transients = 8;  ///< modes beside the discrete one, 0 to PlanarAdjoint::max_modes - 1
};

/// The first moments of a Henyey-Greenstein phase function, g^l.
std::vector<double> henyey_greenstein_moments(double g, int count);

/// Solves for the modes with transients + 1 nodes a half range. The symmetric eigenproblem is that of chandrasekhar1960
/// in the form of stamnes1988. Nodes are Gauss-Legendre's in a variable that is dense at grazing directions, where the
/// radiance at a boundary has its singularity (the error then falls with the fourth power of their number instead of
/// the second; docs/theory/planar.md), less so the more the phase function needs its moments integrated, and split at
/// the critical angle of a refractive boundary. A slab of albedo 1 is solved for an albedo below by what exponentials
/// need. Throws std::invalid_argument for values outside their ranges.
PlanarModes solve_planar(const PlanarProblem& problem);

}  // namespace wend
