#include <wend/core/error.h>
#include <wend/io/spectrum/blackbody.h>
#include <wend/io/spectrum/colorimetry.h>
#include <wend/io/spectrum/white_balance.h>

#include <fmt/format.h>

namespace wend {
namespace {

// lam1985: from tristimulus values to responses of the eye.
constexpr ColourMatrix bradford{{{{0.8951, 0.2664, -0.1614}, {-0.7502, 1.7135, 0.0367}, {0.0389, -0.0685, 1.0296}}}};

using Tristimulus = std::array<double, 3>;

/// Of luminance 1.
Tristimulus from_chromaticity(double x, double y) {
    return {x / y, 1, (1 - x - y) / y};
}

/// Daylight by the CIE's polynomials (cie15), whose temperatures are by an older constant of Planck's law.
Tristimulus daylight(double temperature) {
    const double t = temperature * 1.4388 / 1.4380;
    if (t < 4000) {
        const Xyz white = blackbody_xyz(t);
        return {white.x / white.y, 1, white.z / white.y};
    }
    const double x = t <= 7000 ? ((-4.6070e9 / t + 2.9678e6) / t + 0.09911e3) / t + 0.244063
                               : ((-2.0064e9 / t + 1.9018e6) / t + 0.24748e3) / t + 0.237040;
    return from_chromaticity(x, (-3 * x + 2.870) * x - 0.275);
}

}  // namespace

ColourMatrix white_balance(double temperature) {
    constexpr double lowest = 1000, highest = 100000;
    if (!(temperature >= lowest && temperature <= highest)) {
        throw InputError(
            fmt::format("the white of {} K: it must lie between {} and {} K", temperature, lowest, highest));
    }
    const Tristimulus from = bradford * daylight(temperature), to = bradford * from_chromaticity(0.3127, 0.3290);
    const ColourMatrix scaled = ColourMatrix::diagonal(to[0] / from[0], to[1] / from[1], to[2] / from[2]);
    return rgb_from_xyz_matrix() * bradford.inverse() * scaled * bradford * rgb_from_xyz_matrix().inverse();
}

}  // namespace wend
