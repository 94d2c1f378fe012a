#include <wend/planar/albedo_inversion.h>

#include <wend/medium/fresnel.h>
#include <wend/numeric/interpolation.h>
#include <wend/numeric/quadrature.h>
#include <wend/planar/discrete_ordinates.h>

#include <boost/math/interpolators/pchip.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

namespace wend {
namespace {

constexpr double most_peaked = 0.95;
constexpr int steps = 24;
constexpr int table_steps = 256;
constexpr int transients = 15;

/// The albedo with this mean cosine of a medium that diffuses light like an isotropic one of albedo 1 - root².
double similar_albedo(double root, double mean_cosine) {
    const double isotropic = (1 - root) * (1 + root);
    return isotropic / (1 - mean_cosine + mean_cosine * isotropic);
}

/// The light that leaves, of what has entered, under an even sky.
double reflectance(double albedo, double mean_cosine, double ior) {
    PlanarProblem problem;
    problem.albedo = albedo;
    problem.moments = henyey_greenstein_moments(mean_cosine, mean_cosine == 0 ? 1 : 2 * (transients + 1));
    problem.transients = transients;
    problem.slab.near.ior = ior;
    problem.slab.near.illumination = [](double /*cosine*/) { return 1.0; };
    const PlanarAdjoint adjoint(solve_planar(problem), problem.slab);
    // The square root of the cosine crowds at grazing directions, where radiance is singular.
    const Quadrature rule = gauss_legendre(32);
    double entered = 0, left = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double outside = rule.nodes[i] * rule.nodes[i];
        const double weight = rule.weights[i] * rule.nodes[i] * outside * (1 - fresnel_dielectric(outside, ior));
        entered += weight;
        left += weight * adjoint.radiance(0, std::sqrt(1 - (1 - outside * outside) / (ior * ior)));
    }
    return left / entered;
}

std::vector<double> roots_by_reflectance(double mean_cosine, double ior) {
    std::vector<double> reflectances = {0}, roots = {1};
    for (int i = steps - 1; i > 0; --i) {
        // Dense towards 0, where behind a refractive boundary reflectance falls fast.
        const double even = static_cast<double>(i) / steps;
        roots.push_back(even * even);
        reflectances.push_back(reflectance(similar_albedo(roots.back(), mean_cosine), mean_cosine, ior));
    }
    reflectances.push_back(1);
    roots.push_back(0);
    const boost::math::interpolators::pchip monotonic(std::move(reflectances), std::move(roots));
    std::vector<double> values;
    for (int i = 0; i <= table_steps; ++i) {
        values.push_back(monotonic(static_cast<double>(i) / table_steps));
    }
    return values;
}

}  // namespace

AlbedoInversion::AlbedoInversion(double mean_cosine, double ior)
    : mean_cosine_(mean_cosine),
      roots_(roots_by_reflectance(std::clamp(mean_cosine, -most_peaked, most_peaked), std::clamp(ior, 1.0, 3.0))) {
}

float AlbedoInversion::operator()(float reflectance) const {
    const double share = reflectance > 0 ? static_cast<double>(reflectance) : 0.0;  // NaN as well
    return static_cast<float>(similar_albedo(interpolate(roots_, share), mean_cosine_));
}

}  // namespace wend
