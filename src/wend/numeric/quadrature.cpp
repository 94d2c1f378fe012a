#include <wend/numeric/quadrature.h>

#include <wend/core/contracts.h>

#include <cmath>
#include <numbers>

namespace wend {
namespace {

struct PolynomialValue {
    long double value;
    long double derivative;
};

/// Legendre's polynomial of degree >= 1 inside (-1, 1).
PolynomialValue legendre(int degree, long double x) {
    long double before = 1;
    long double value = x;
    for (int n = 2; n <= degree; ++n) {
        const long double next = ((2 * n - 1) * x * value - (n - 1) * before) / n;
        before = value;
        value = next;
    }
    return {value, degree * (before - x * value) / (1 - x * x)};
}

}  // namespace

Quadrature gauss_legendre(int count, double begin, double end) {
    WEND_EXPECT(count >= 1);
    const auto n = static_cast<std::size_t>(count);
    Quadrature rule{std::vector<double>(n), std::vector<double>(n)};
    const long double centre = (static_cast<long double>(begin) + end) / 2;
    const long double half = (static_cast<long double>(end) - begin) / 2;
    for (std::size_t i = 0; i < (n + 1) / 2; ++i) {
        // The guess is within 1e-2 of the distance to the next root, where Newton's method converges in four steps.
        long double x =
            std::cos(std::numbers::pi_v<long double> * (static_cast<long double>(i) + 0.75L) / (count + 0.5L));
        PolynomialValue p = legendre(count, x);
        for (int step = 0; step < 5; ++step) {
            x -= p.value / p.derivative;
            p = legendre(count, x);
        }
        const std::size_t mirrored = n - 1 - i;
        rule.nodes[i] = static_cast<double>(centre - half * x);
        rule.nodes[mirrored] = static_cast<double>(centre + half * x);
        rule.weights[i] = rule.weights[mirrored] =
            static_cast<double>(2 * half / ((1 - x * x) * p.derivative * p.derivative));
    }
    return rule;
}

}  // namespace wend
