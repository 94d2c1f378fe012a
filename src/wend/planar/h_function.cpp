#include <wend/planar/h_function.h>

#include <wend/core/contracts.h>
#include <wend/numeric/quadrature.h>

#include <cmath>
#include <numbers>

namespace wend {
namespace {

// ln H(mu) = -(mu/π) ∫_0^∞ ln(L(t)) / (1 + mu² t²) dt with the dispersion relation L(t) = 1 - albedo atan(t)/t. The
// factor (t² + k²) / (t² + 1), which vanishes where L does and whose integral is known, is taken out of L:
//     ln H(mu) = ln((1 + mu) / (1 + k mu)) - (mu/π) ∫_0^∞ ln(M(t)) / (1 + mu² t²) dt,   M(t) = L(t) (t² + 1) / (t² +
//     k²).
// M stays between M(0) = (1 - albedo)/k² >= 1/3 and about 1. As a function of ln t the integrand is analytic within π/2
// of the real axis, so that the trapezoidal rule with step h errs by exp(-π²/h).
constexpr double step = 0.26;
constexpr int first_node = -144;  // t = 5e-17
constexpr int last_node = 136;    // t = 2e15

/// 1 - atan(t)/t without cancellation.
double arctangent_defect(double t) {
    if (t > 0.3) {
        return 1 - std::atan(t) / t;
    }
    const double x = t * t;
    double sum = 0;
    for (int n = 18; n >= 1; --n) {
        sum = x * (1.0 / (2 * n + 1) - sum);
    }
    return sum;
}

double log_smooth_part(double t, double albedo, const DiscreteEigenvalue& eigenvalue) {
    const double square = t * t;
    const double denominator = square + eigenvalue.k * eigenvalue.k;
    if (t > 1 || albedo < 0.5) {
        // M is close to 1.
        const double atan_over_t = t > 0 ? std::atan(t) / t : 1;
        const double absent = eigenvalue.gap * (1 + eigenvalue.k);
        return std::log1p((absent - albedo * atan_over_t * (1 + square)) / denominator);
    }
    return std::log((1 - albedo + albedo * arctangent_defect(t)) * (1 + square) / denominator);
}

}  // namespace

HFunction::HFunction(double albedo) : albedo_(albedo), eigenvalue_(discrete_eigenvalue(albedo)) {
    limit_ = albedo < 1 ? log_smooth_part(0, albedo, eigenvalue_) : -std::log(3.0);
    for (int i = first_node; i <= last_node; ++i) {
        const double t = std::exp(i * step);
        nodes_.push_back({t, log_smooth_part(t, albedo, eigenvalue_) * step / std::numbers::pi});
    }
}

double HFunction::logarithm(double mu) const {
    WEND_EXPECT(mu >= 0);
    if (std::isinf(mu)) {
        return -0.5 * std::log1p(-albedo_);
    }
    // The nodes reach as far as ln M or 1/t is below rounding. Above mu = 1 they do so only after M(0) is taken out
    // too.
    const double limit = mu > 1 ? limit_ : 0;
    const double limit_weight = limit * step / std::numbers::pi;
    double sum = limit / 2;
    for (const Node& node : nodes_) {
        const double x = mu * node.t;
        sum += (node.weight - limit_weight) / (x + 1 / x);  // both ends are reached without overflow
    }
    return std::log1p(mu * eigenvalue_.gap / (1 + eigenvalue_.k * mu)) - sum;
}

double HFunction::operator()(double mu) const {
    return std::exp(logarithm(mu));
}

double HFunction::moment(int degree) const {
    // H has a term mu ln mu at 0, which the substitution mu = t³ smooths.
    const Quadrature rule = gauss_legendre(64);
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double t = rule.nodes[i];
        const double mu = t * t * t;
        sum += rule.weights[i] * 3 * t * t * std::pow(mu, degree) * (*this)(mu);
    }
    return sum;
}

}  // namespace wend
