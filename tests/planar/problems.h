// Plane-parallel problems and what is seen of them, for tests.
#pragma once

#include <wend/core/vector.h>
#include <wend/medium/fresnel.h>
#include <wend/numeric/quadrature.h>
#include <wend/planar/adjoint.h>
#include <wend/planar/discrete_ordinates.h>

#include <cmath>

namespace wend::test {

inline double white(double /*cosine*/) {
    return 1;
}

struct Lit {
    bool near, far;
};
inline constexpr Lit from_near{true, false};
inline constexpr Lit from_far{false, true};
inline constexpr Lit from_both{true, true};

/// A layer with equal boundaries under white skies.
inline PlanarProblem planar_problem(double albedo, double g, double thickness, int transients, Lit lit = from_near,
                                    double ior = 1) {
    PlanarProblem problem;
    problem.albedo = albedo;
    if (g != 0) {
        problem.moments = henyey_greenstein_moments(g, 2 * PlanarAdjoint::max_modes);
    }
    problem.transients = transients;
    problem.slab.thickness = thickness;
    problem.slab.near.ior = problem.slab.far.ior = ior;
    if (lit.near) {
        problem.slab.near.illumination = white;
    }
    if (lit.far) {
        problem.slab.far.illumination = white;
    }
    return problem;
}

inline PlanarAdjoint solved(const PlanarProblem& problem) {
    return {solve_planar(problem), problem.slab};
}

/// What a camera outside the near side sees that comes from inside the medium.
inline double seen_inside(const PlanarAdjoint& adjoint, double mu0) {
    const double ior = adjoint.slab().near.ior;
    const double inside = std::sqrt(1 - (1 - mu0 * mu0) / (ior * ior));
    const double passes = ior == 1 ? 1 : 1 - fresnel_dielectric(mu0, ior);
    return passes * adjoint.radiance(0, inside);
}

/// All that it sees: what the boundary reflects of a white sky, too.
inline double seen(const PlanarAdjoint& adjoint, double mu0) {
    const double ior = adjoint.slab().near.ior;
    return seen_inside(adjoint, mu0) + (ior == 1 ? 0 : fresnel_dielectric(mu0, ior));
}

/// ∫ f(mu0) 2 mu0 dmu0 over (0,1): what Lambertian incidence makes of it.
template <class Function>
double diffuse_mean(const Function& f) {
    const Quadrature rule = gauss_legendre(96);
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double s = rule.nodes[i];
        sum += rule.weights[i] * 4 * s * s * s * f(s * s);  // mu0 = s², dense at grazing directions
    }
    return sum;
}

}  // namespace wend::test
