#include <wend/planar/discrete_ordinates.h>
#include <wend/planar/lit_layers.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend {
namespace {

/// Of those that are not a half-space.
constexpr int sizes = 5;
/// Few are enough: what is left to chance comes from the shape, which no layer has.
constexpr int transients = 4;
/// A layer of less absorption is hard to sample (docs/theory/planar.md).
constexpr double least_decay = 0.3;

double guide_albedo(double albedo, double g, double thickness) {
    const double rate = std::isinf(thickness) ? 1e-3 : least_decay / (thickness + 1.42 / (1 - g));
    return std::min(albedo, std::max(1 - rate * rate / (3 * (1 - g)), 0.9));
}

}  // namespace

std::vector<PlanarAdjoint> lit_layers(double albedo, double mean_cosine, double ior) {
    const double g = std::clamp(mean_cosine, -0.95, 0.95);
    PlanarProblem problem;
    problem.moments = henyey_greenstein_moments(g, g == 0 ? 1 : 2 * (transients + 1));
    problem.transients = transients;
    problem.slab.near.ior = problem.slab.far.ior = ior;
    problem.slab.near.illumination = [](double /*cosine*/) { return 1.0; };
    std::vector<PlanarAdjoint> layers;
    for (int i = 0; i <= sizes; ++i) {
        problem.slab.thickness = i < sizes ? std::exp2(i) : std::numeric_limits<double>::infinity();
        problem.albedo = guide_albedo(albedo, g, problem.slab.thickness);
        layers.emplace_back(solve_planar(problem), problem.slab).keep_positive();
    }
    return layers;
}

}  // namespace wend
