// Rules that turn integrals into weighted sums.
#pragma once

#include <vector>

namespace wend {

/// ∫ f ≈ Σ weights[i] f(nodes[i]); the nodes increase.
struct Quadrature {
    std::vector<double> nodes;
    std::vector<double> weights;
};

/// Gauss and Legendre's rule on [begin, end], exact for polynomials of degree 2 count - 1; count >= 1. Nodes and
/// weights are accurate to about 1e-15 of the interval. Costs count² operations.
Quadrature gauss_legendre(int count, double begin = 0, double end = 1);

}  // namespace wend
