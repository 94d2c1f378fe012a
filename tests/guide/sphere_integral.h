// Integrals over the sphere for comparisons with closed forms.
#pragma once

#include <wend/core/vector.h>

#include <cmath>

namespace wend::test {

/// ∫ f dω by the midpoint rule on rows × 2 rows cells of equal solid angle.
template <class Function>
double integrate_sphere(const Function& f, int rows = 200) {
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        const double z = -1 + (2 * i + 1.0) / rows;
        const double r = std::sqrt(1 - z * z);
        for (int j = 0; j < 2 * rows; ++j) {
            const double azimuth = pi * (j + 0.5) / rows;
            sum += f(Vec3(static_cast<float>(r * std::cos(azimuth)), static_cast<float>(r * std::sin(azimuth)),
                          static_cast<float>(z)));
        }
    }
    return sum * 2 * pi / (static_cast<double>(rows) * rows);
}

/// Kullback–Leibler divergence ∫ p ln(p/q) dω of q from the truth p.
template <class Truth, class Guess>
double divergence(const Truth& p, const Guess& q, int rows = 200) {
    return integrate_sphere(
        [&](const Vec3& w) {
            const double pw = p.density(w);
            return pw > 1e-30 ? pw * std::log(pw / static_cast<double>(q.density(w))) : 0.0;
        },
        rows);
}

}  // namespace wend::test
