// Chandrasekhar's H function.
#pragma once

#include <wend/planar/eigenvalue.h>

#include <vector>

namespace wend {

/// The H function of isotropic scattering (chandrasekhar1960, chapter V) for one albedo in [0, 1]: the half-space of
/// matched boundary, lit from the direction mu0, shines with (albedo / 4) H(mu) H(mu0) mu0 / (mu + mu0).
/// A table made at construction (about 20 µs) makes a value cost about a microsecond.
class HFunction {
public:
    explicit HFunction(double albedo);

    /// H(mu) for mu in [0, infinity]; relative error below 1e-13. Grows from 1 to 1/sqrt(1 - albedo).
    double operator()(double mu) const;

    /// ln H(mu), accurate in relative terms also where H is close to 1.
    double logarithm(double mu) const;

    /// ∫_0^1 H(mu) mu^degree dmu; relative error below 1e-13. Costs about 0.1 ms.
    double moment(int degree) const;

    double albedo() const { return albedo_; }
    const DiscreteEigenvalue& eigenvalue() const { return eigenvalue_; }

private:
    struct Node {
        double t;
        double weight;  // ln M(t) times the step in ln t, over π
    };

    double albedo_;
    DiscreteEigenvalue eigenvalue_;
    double limit_;  // ln M(0)
    std::vector<Node> nodes_;
};

}  // namespace wend
