#include <wend/lab/roulette_splitting.h>

#include <cmath>

namespace wend {
namespace {

int roulette(double& weight, double probability, Pcg32& random) {
    if (random.uniform_double() >= probability) {
        return 0;
    }
    weight /= probability;
    return 1;
}

struct Copies {
    double& weight;
    double depth;
    double cosine;
    Pcg32& random;

    int operator()(const EndlessSurvival& /*rule*/) const { return 1; }
    int operator()(const LowWeightRoulette& rule) const {
        return weight < rule.threshold ? roulette(weight, 0.5, random) : 1;
    }
    int operator()(const WeightRoulette& /*rule*/) const { return weight < 1 ? roulette(weight, weight, random) : 1; }
    int operator()(const AdjointWindow& rule) const {
        const double expected = weight * rule.adjoint->radiance(depth, cosine);
        const WeightWindow::Outcome outcome = rule.window.sample(expected / rule.reference, random);
        weight /= outcome.expected;
        return outcome.copies;
    }
};

}  // namespace

int PlanarSurvival::copies(double& weight, double depth, double cosine, std::uint64_t collisions, Pcg32& random) const {
    // Without absorption a walk in a half-space returns for certain, but after no finite time in the mean. So long ones
    // are thinned as the inverse square root of their length: the sums for their mean length and for their second
    // moment then both grow with the logarithm alone, and the mean is kept.
    constexpr std::uint64_t long_walk = 10000;
    if (collisions > long_walk) {
        const auto n = static_cast<double>(collisions);
        if (roulette(weight, std::sqrt((n - 1) / n), random) == 0) {
            return 0;
        }
    }
    return std::visit(Copies{weight, depth, cosine, random}, rule_);
}

}  // namespace wend
