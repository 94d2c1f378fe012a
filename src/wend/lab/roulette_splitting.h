// What ends or splits a planar walk beyond absorption.
#pragma once

#include <wend/decision/roulette_splitting.h>
#include <wend/planar/adjoint.h>

#include <cstdint>
#include <variant>

namespace wend {

/// Absorption lowers the weight.
struct ImplicitCapture {
    static bool survive(double albedo, double& weight, Pcg32& /*random*/) {
        weight *= albedo;
        return weight > 0;
    }
};

/// Absorption ends the walk.
struct AnalogCapture {
    static bool survive(double albedo, double& /*weight*/, Pcg32& random) { return random.uniform_double() < albedo; }
};

/// Every walk goes on.
struct EndlessSurvival {};

/// Roulette with survival 1/2 below a weight.
struct LowWeightRoulette {
    double threshold = 1e-3;
};

/// A window around the expected contribution: weight times radiance, over the value of all walks.
struct AdjointWindow {
    const PlanarAdjoint* adjoint;
    double reference;  ///< > 0
    WeightWindow window;
};

/// Roulette with the weight as probability of survival: for comparison, since it undoes a guide.
struct WeightRoulette {};

/// The rule of a walk, applied after each collision.
class PlanarSurvival {
public:
    using Rule = std::variant<EndlessSurvival, LowWeightRoulette, AdjointWindow, WeightRoulette>;
    explicit PlanarSurvival(Rule rule) : rule_(rule) {}

    /// How many branches go on from here, each with the weight that is left in `weight`.
    int copies(double& weight, double depth, double cosine, std::uint64_t collisions, Pcg32& random) const;

private:
    Rule rule_;
};

}  // namespace wend
