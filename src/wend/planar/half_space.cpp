#include <wend/planar/half_space.h>

#include <wend/core/contracts.h>
#include <wend/core/vector.h>
#include <wend/planar/h_function.h>

#include <cmath>

namespace wend {
namespace {

/// 1 - sqrt(1 - albedo) H(mu), for mu in [0, infinity]: nothing cancels for a small albedo.
double reflectance(const HFunction& h, double mu) {
    return h.albedo() < 1 ? -std::expm1(0.5 * std::log1p(-h.albedo()) + h.logarithm(mu)) : 1;
}

/// The second moment of a walk stretched by 1 + mu/nu, k = 1/nu, whose squared weights make a half-space of albedo
/// h.albedo().
double second_moment(const HFunction& h, double k, double mu0, FirstFlight first) {
    const double mu = first == FirstFlight::stretched ? mu0 : mu0 / (1 + k * mu0);
    return (reflectance(h, mu) * (1 + k * mu) - k * h.albedo() * h.moment(1) * h(mu) / 2) / (1 + k * mu0);
}

}  // namespace

double reflectance(double albedo, double mu0) {
    return reflectance(HFunction(albedo), mu0);
}

double diffuse_reflectance(double albedo) {
    return 1 - 2 * std::sqrt(1 - albedo) * HFunction(albedo).moment(1);
}

double uniform_reflectance(double albedo) {
    const double r = std::sqrt(1 - albedo);
    return albedo / ((1 + r) * (1 + r));
}

double classical_variance(double albedo, double mu0) {
    const double mean = reflectance(albedo, mu0);
    return reflectance(albedo * albedo, mu0) - mean * mean;
}

double dwivedi_variance(double albedo, double mu0, FirstFlight first) {
    // albedo nu atanh(1/nu) = 1 makes the effective albedo the albedo itself.
    const HFunction h(albedo);
    const double mean = reflectance(h, mu0);
    return second_moment(h, h.eigenvalue().k, mu0, first) - mean * mean;
}

double stretched_second_moment(double albedo, const DiscreteEigenvalue& guide, double mu0, FirstFlight first) {
    const double effective = effective_albedo(albedo, guide);
    return effective <= 1 ? second_moment(HFunction(effective), guide.k, mu0, first) : infinity;
}

double effective_albedo(double albedo, const DiscreteEigenvalue& guide) {
    const double nu_atanh = guide.k > 0 ? std::log1p(2 * guide.k / guide.gap) / (2 * guide.k) : 1;
    return albedo > 0 ? albedo * albedo * nu_atanh : 0;
}

double extrapolation_distance(double albedo) {
    WEND_EXPECT(albedo > 0 && albedo <= 1);
    if (albedo == 1) {
        return 0.71044608959876307;  // Hopf's constant
    }
    // The Laplace transform of the fluence is H(1/s) / (s - k). Its residues at s = ±k are the asymptotic modes: H(nu)
    // of the growing one and, since H(mu) H(-mu) = 1/L(mu), -1 / (2 D H(nu)) of the decaying one, with D = nu L'(nu) =
    // albedo/(1 - k²) - 1. So exp(2 distance/nu) = 2 D H(nu)². Here 1 - k² is written (1 + k)² exp(-2k/albedo), by the
    // dispersion relation, because it may be less than any double.
    const HFunction h(albedo);
    const double k = h.eigenvalue().k;
    const double log_slope = std::log(k * k - (1 - albedo)) - 2 * std::log1p(k) + 2 * k / albedo;
    return (std::log(2.0) + log_slope + 2 * h.logarithm(1 / k)) / (2 * k);
}

FluenceMoments fluence_moments(double albedo) {
    const double r = std::sqrt(1 - albedo);
    if (r == 0) {
        return {1, infinity, infinity, infinity};
    }
    // The Laplace transform of albedo J is (1 - r H(1/s)) / s, and r H(1/s) = 1 / (1 + y(s)) with
    // y = a1 s - a2 s² + a3 s³ - ..., a_i = albedo alpha_i / (2r), alpha_i the moments of H. Expanded in s it has the
    // moments.
    const HFunction h(albedo);
    const double alpha1 = h.moment(1);
    const double alpha2 = h.moment(2);
    const double alpha3 = h.moment(3);
    const double a1 = albedo * alpha1 / (2 * r);
    const double a2 = albedo * alpha2 / (2 * r);
    return {1 / (1 + r), alpha1 / (2 * r), alpha2 / alpha1 + a1, 2 * (alpha3 / alpha1 + 2 * a2 + a1 * a1)};
}

}  // namespace wend
