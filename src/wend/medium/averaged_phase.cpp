#include <wend/medium/averaged_phase.h>

#include <wend/core/contracts.h>
#include <wend/numeric/elliptic.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wend {
namespace {

/// The phase function depends on azimuth by D^(-3/2), D = 1 + g² - 2 g cos(scattering angle). Its extremes are where
/// both directions share a vertical plane.
struct Denominator {
    double aligned;  ///< D at azimuth 0
    double opposed;  ///< D at azimuth π

    Denominator(double g, double mu, double mu_new) {
        WEND_EXPECT(std::abs(g) <= 0.99 && std::abs(mu) <= 1 && std::abs(mu_new) <= 1);
        const double sine = std::sqrt((1 - mu) * (1 + mu));
        const double sine_new = std::sqrt((1 - mu_new) * (1 + mu_new));
        // D = (1 - |g|)² + 2 |g| (1 -+ cosine), where 1 -+ cosine is half the squared length of the sum or difference
        // of two unit vectors: nothing cancels, not even in the peak.
        const double sign = std::copysign(1.0, g);
        const double size = std::abs(g);
        const double vertical = mu - sign * mu_new;
        const auto denominator = [&](double horizontal) {
            return (1 - size) * (1 - size) + size * (vertical * vertical + horizontal * horizontal);
        };
        aligned = denominator(sine - sign * sine_new);
        opposed = denominator(sine + sign * sine_new);
    }

    double at(double phi) const {
        const double c = std::cos(phi / 2);
        const double s = std::sin(phi / 2);
        return aligned * c * c + opposed * s * s;
    }
};

/// The mean over azimuth of 2π times the phase function.
double average(double g, const Denominator& d) {
    const double least = std::min(d.aligned, d.opposed);
    const double most = std::max(d.aligned, d.opposed);
    return (1 - g * g) * elliptic_e((most - least) / most) / (std::numbers::pi * least * std::sqrt(most));
}

}  // namespace

double averaged_henyey_greenstein(double g, double mu, double mu_new) {
    if (g == 0) {
        return 0.5;
    }
    return average(g, Denominator(g, mu, mu_new));
}

double azimuth_density(double g, double mu, double mu_new, double phi) {
    const Denominator denominator(g, mu, mu_new);
    const double d = denominator.at(phi);
    return (1 - g * g) / (4 * std::numbers::pi * d * std::sqrt(d)) / average(g, denominator);
}

double sample_azimuth(double g, double mu, double mu_new, Pcg32& random) {
    // The density proportional to 1/D is inverted in closed form, in terms of the tangent of half the angle from the
    // most likely azimuth; the rest, sqrt(least / D), is left to rejection.
    const Denominator d(g, mu, mu_new);
    const double least = std::min(d.aligned, d.opposed);
    const double most = std::max(d.aligned, d.opposed);
    const double ratio = least / most;
    for (;;) {
        const double tangent = std::tan(std::numbers::pi * (random.uniform_double() - 0.5));
        const double tangent2 = tangent * tangent;
        const double u = random.uniform_double();
        if (!(u * u * (1 + tangent2) > 1 + ratio * tangent2)) {  // accepts what is not a number, too
            const double phi = 2 * std::atan(std::sqrt(ratio) * tangent);
            return d.aligned <= d.opposed ? phi : phi - std::copysign(std::numbers::pi, phi);
        }
    }
}

}  // namespace wend
