#include <wend/io/spectrum/white_balance.h>

#include <wend/core/error.h>
#include <wend/io/spectrum/blackbody.h>
#include <wend/io/spectrum/colorimetry.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

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

/// What a sensor's colours are over those that white_balance() has, at a temperature.
struct SensorColours {
    double temperature;
    ColourMatrix colours;
};

// Of the Nikon D850, from its responses, the 24 patches of a ColorChecker and the CIE's daylight, at 1 nm.
constexpr std::array<SensorColours, 4> nikon_d850{{
    {4000, {{{{0.8686, 0.1465, -0.0526}, {-0.0219, 1.0232, -0.0148}, {-0.0307, 0.0237, 0.9102}}}}},
    {5000, {{{{0.9343, 0.0692, -0.0334}, {-0.0119, 1.0152, -0.0118}, {-0.0110, 0.0075, 0.9516}}}}},
    {6500, {{{{0.9982, -0.0026, -0.0127}, {-0.0006, 1.0002, -0.0038}, {-0.0009, -0.0024, 0.9863}}}}},
    {10000, {{{{1.0669, -0.0756, 0.0130}, {0.0155, 0.9738, 0.0122}, {0.0037, -0.0079, 1.0186}}}}},
}};

/// Interpolated in the inverse of the temperature, by which the colours of daylight are about evenly spaced.
ColourMatrix colours_of_sensor(double temperature) {
    const double t = std::clamp(temperature, nikon_d850.front().temperature, nikon_d850.back().temperature);
    std::size_t i = 0;
    while (i + 2 < nikon_d850.size() && t > nikon_d850[i + 1].temperature) {
        ++i;
    }
    const SensorColours &warm = nikon_d850[i], &cool = nikon_d850[i + 1];
    const double part = (1 / warm.temperature - 1 / t) / (1 / warm.temperature - 1 / cool.temperature);
    ColourMatrix between;
    for (std::size_t row = 0; row < 3; ++row) {
        for (std::size_t column = 0; column < 3; ++column) {
            between.m[row][column] = std::lerp(warm.colours.m[row][column], cool.colours.m[row][column], part);
        }
    }
    return between;
}

}  // namespace

ColourMatrix adaptation(const std::array<double, 3>& from, const std::array<double, 3>& to) {
    const Tristimulus seen_from = bradford * from, seen_to = bradford * to;
    const ColourMatrix scaled =
        ColourMatrix::diagonal(seen_to[0] / seen_from[0], seen_to[1] / seen_from[1], seen_to[2] / seen_from[2]);
    return bradford.inverse() * scaled * bradford;
}

ColourMatrix sensor_balance(double temperature) {
    return colours_of_sensor(temperature) * white_balance(temperature);
}

ColourMatrix white_balance(double temperature) {
    constexpr double lowest = 1000, highest = 100000;
    if (!(temperature >= lowest && temperature <= highest)) {
        throw InputError(
            fmt::format("the white of {} K: it must lie between {} and {} K", temperature, lowest, highest));
    }
    return rgb_from_xyz_matrix() * adaptation(daylight(temperature), from_chromaticity(0.3127, 0.3290)) *
           rgb_from_xyz_matrix().inverse();
}

}  // namespace wend
