#include <wend/sampling/vmf.h>

#include <wend/core/contracts.h>
#include <wend/core/vector.h>
#include <wend/numeric/fast_math.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Mean cosine in double precision; the series and the closed form agree to 1e-13 where one takes over.
double mean_cosine(double kappa) {
    if (kappa < 0.05) {
        const double k2 = kappa * kappa;
        return kappa * (1.0 / 3 - k2 * (1.0 / 45 - k2 * (2.0 / 945 - k2 / 4725)));
    }
    return 1 / std::tanh(kappa) - 1 / kappa;
}

}  // namespace

float vmf_peak(float kappa) {
    return kappa > 0 ? kappa / (-2 * pi * std::expm1(-2 * kappa)) : inv_4pi;
}

float vmf_mean_cosine(float kappa) {
    return static_cast<float>(mean_cosine(kappa));
}

float vmf_kappa(float cosine) {
    constexpr double limit = 1 - 1.0 / Vmf::max_kappa;
    const double r = cosine;
    if (!(r > 0)) {
        return 0;
    }
    if (r >= limit) {
        return Vmf::max_kappa;
    }
    double kappa = r * (3 - r * r) / (1 - r * r);
    // The start is within 5 %, and the error is squared by each step. The derivative is 1 - r² - 2 r / kappa.
    for (int step = 0; step < 3; ++step) {
        const double guess = mean_cosine(kappa);
        kappa -= (guess - r) / (1 - guess * guess - 2 * guess / kappa);
    }
    return std::min(static_cast<float>(kappa), Vmf::max_kappa);
}

Vmf convolve(const Vmf& lobe, float kappa) {
    return {lobe.mean, vmf_kappa(vmf_mean_cosine(lobe.kappa) * vmf_mean_cosine(kappa))};
}

}  // namespace wend
