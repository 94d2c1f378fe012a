#include <wend/planar/case_modes.h>

#include <wend/core/contracts.h>
#include <wend/numeric/quadrature.h>
#include <wend/planar/h_function.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace wend {

// The Laplace transform of albedo J is (1 - r H(1/s)) / s, r = sqrt(1 - albedo). Its pole at s = -1/nu is the discrete
// mode, its cut s < -1 the continuum.
CaseModes case_modes(double albedo, int transients) {
    WEND_EXPECT(albedo >= 0 && albedo <= 1 && transients >= 0);
    if (albedo == 0) {
        return {};
    }
    if (albedo == 1) {
        return {{std::numeric_limits<double>::infinity()}, {1}};
    }
    const HFunction h(albedo);
    const auto& [k, gap] = h.eigenvalue();
    const double r = std::sqrt(1 - albedo);
    // r / (albedo H(nu) D) with D = albedo/(1 - k²) - 1, which is infinite where k rounds to 1.
    const double discrete = r * gap * (1 + k) / (albedo * h(1 / k) * (k * k - (1 - albedo)));
    CaseModes modes{{1 / k}, {discrete}};
    if (transients > 0) {
        const Quadrature rule = gauss_legendre(transients);
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            const double t = rule.nodes[i];
            const double nu = t * t * (3 - 2 * t);
            const double below_one = (1 - t) * (1 - t) * (1 + 2 * t);
            const double real = 1 - albedo * nu * std::log((1 + nu) / below_one) / 2;
            const double imaginary = std::numbers::pi * albedo * nu / 2;
            modes.nu.push_back(nu);
            modes.coefficient.push_back(rule.weights[i] * 6 * t * (1 - t) * r /
                                        (2 * h(nu) * (real * real + imaginary * imaginary)));
        }
    }
    return modes;
}

}  // namespace wend
