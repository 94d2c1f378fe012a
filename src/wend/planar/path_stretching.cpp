#include <wend/planar/path_stretching.h>

#include <wend/core/vector.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wend {

PlanarFlight PathStretching::sample(const Site& from, double mu, Pcg32& random, Site& to) const {
    const double boundary = mu >= 0 ? (thickness_ - from.depth) / mu : from.depth / -mu;
    const double rate = 1 - stretch_ * mu;
    const double s = -std::log1p(-random.uniform_double()) / rate;
    if (!(s < boundary)) {
        return {false, boundary, std::exp((1 - rate) * boundary)};
    }
    to.depth = from.depth + s * mu;
    return {true, s, rate * std::exp((1 - rate) * s)};
}

double PathStretching::density_ratio(const Site& /*from*/, double mu, const PlanarFlight& outcome,
                                     const Site& /*to*/) const {
    const double rate = 1 - stretch_ * mu;
    // A flight of another sampler may be so long that the factor is out of range.
    return (outcome.scatters ? rate : 1) * std::exp(std::min((1 - rate) * outcome.length, 700.0));
}

PlanarDirection PhaseDirection::sample(double /*depth*/, double before, Pcg32& random) const {
    const double t = 2 * random.uniform_double() - 1;
    if (g_ == 0) {
        return {t, 1};
    }
    // Either form inverts the distribution exactly; the first is accurate near g = 0, the second near |g| = 1.
    double cosine;
    if (std::abs(g_) < 0.5) {
        const double numerator = t + g_ * (0.5 * (3 + t * t) + g_ * (t + g_ * 0.5 * (t * t - 1)));
        cosine = numerator / ((1 + g_ * t) * (1 + g_ * t));
    } else {
        const double s = (1 - g_ * g_) / (1 + g_ * t);
        cosine = (1 + g_ * g_ - s * s) / (2 * g_);
    }
    cosine = std::clamp(cosine, -1.0, 1.0);
    const double azimuth = std::numbers::pi * random.uniform_double();
    const double sines = std::sqrt((1 - cosine * cosine) * std::max(0.0, 1 - before * before));
    return {std::clamp(before * cosine + sines * std::cos(azimuth), -1.0, 1.0), 1};
}

// In k = 1/nu, where nothing cancels: neither as k -> 1 (no scattering) nor as k -> 0 (no absorption).
DwivediDirection::DwivediDirection(double gap, Heading heading)
    : gap_(std::clamp(gap, 1e-9, 1.0)),
      k_(std::max(1 - gap_, 1e-12)),
      logarithm_(std::log1p(2 * k_ / gap_)),
      sign_(heading == Heading::far ? 1 : -1) {
}

PlanarDirection DwivediDirection::sample(double /*depth*/, double /*before*/, Pcg32& random) const {
    const double exponent = -logarithm_ * random.uniform_double();
    const double cosine = -1 - (1 + k_) / k_ * std::expm1(exponent);
    return {sign_ * std::clamp(cosine, -1.0, 1.0), 2 * k_ / (logarithm_ * (1 + k_) * std::exp(exponent))};
}

double DwivediDirection::density_ratio(double /*depth*/, double /*before*/, double after) const {
    return 2 * k_ / (logarithm_ * (gap_ + k_ * (1 - sign_ * after)));
}

}  // namespace wend
