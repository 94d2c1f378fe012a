#include <wend/planar/moment_match.h>

#include <wend/numeric/quadrature.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace wend {
namespace {

using Moments3 = std::array<double, 3>;

/// ∫ z^n exp(-z rate) dz over [0, thickness], for n = 0, 1, 2; `rate` >= 0, positive in a half-space.
Moments3 falling(double rate, double thickness) {
    constexpr double depth_of_nothing = 45;
    if (std::isinf(thickness) || rate * thickness > depth_of_nothing) {
        return {1 / rate, 1 / (rate * rate), 2 / (rate * rate * rate)};
    }
    static const Quadrature rule = gauss_legendre(64);
    Moments3 m{};
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double z = rule.nodes[i] * thickness;
        const double w = rule.weights[i] * thickness * std::exp(-z * rate);
        m[0] += w;
        m[1] += w * z;
        m[2] += w * z * z;
    }
    return m;
}

/// The same of exp(-(thickness - z) rate): moments about the other end.
Moments3 growing(double rate, double thickness) {
    const Moments3 m = falling(rate, thickness);
    return {m[0], thickness * m[0] - m[1], thickness * thickness * m[0] - 2 * thickness * m[1] + m[2]};
}

/// What a set of modes amounts to, seen from the lit side.
struct Total {
    Moments3 moments{};         // of the directional mean of the source
    double at_lit = 0;          // the mean there
    std::vector<double> shape;  // Legendre coefficients of the source integrated over depth
};

Total sum_up(const std::vector<PlanarModes::Mode>& modes, std::size_t first, double thickness, bool lit_at_far) {
    Total total;
    for (std::size_t k = first; k < modes.size(); ++k) {
        const PlanarModes::Mode& mode = modes[k];
        const double rate = 1 / mode.length;
        // Seen from a lit far side the roles are exchanged.
        const double falls = lit_at_far ? mode.far : mode.near;
        const double grows = lit_at_far ? mode.near : mode.far;
        const Moments3 down = falls != 0 ? falling(rate, thickness) : Moments3{};
        const Moments3 up = grows != 0 ? growing(rate, thickness) : Moments3{};
        for (std::size_t n = 0; n < 3; ++n) {
            total.moments[n] += mode.shape[0] * (falls * down[n] + grows * up[n]);
        }
        total.at_lit += mode.shape[0] * (falls + (grows != 0 ? grows * std::exp(-thickness * rate) : 0));
        total.shape.resize(std::max(total.shape.size(), mode.shape.size()));
        for (std::size_t l = 0; l < mode.shape.size(); ++l) {
            const double mirrored = l % 2 == 0 ? 1 : -1;
            total.shape[l] += mode.shape[l] * (mode.near * (lit_at_far ? up : down)[0] +
                                               mirrored * mode.far * (lit_at_far ? down : up)[0]);
        }
    }
    return total;
}

/// The rate at which the ratio of the moments n + 1 and n of a falling exponential is `ratio`; 0 where even a constant
/// has a smaller one.
double rate_for(double ratio, std::size_t n, double thickness) {
    if (std::isinf(thickness)) {
        return static_cast<double>(n + 1) / ratio;
    }
    const auto ratio_at = [&](double rate) {
        const Moments3 m = falling(rate, thickness);
        return m[n + 1] / m[n];
    };
    if (!(ratio_at(0) > ratio)) {
        return 0;
    }
    double low = 0, high = 2 * static_cast<double>(n + 1) / ratio;
    for (int i = 0; i < 80; ++i) {
        const double middle = (low + high) / 2;
        (ratio_at(middle) > ratio ? low : high) = middle;
    }
    return (low + high) / 2;
}

/// A mode that falls from the lit side, of the given shape, scaled so that its n-th moment is `moment`.
PlanarModes::Mode falling_mode(const Total& total, double rate, std::size_t n, double thickness, bool lit_at_far) {
    PlanarModes::Mode mode;
    mode.length = rate > 0 ? 1 / rate : std::numeric_limits<double>::infinity();
    const double amplitude = total.moments[n] / falling(rate, thickness)[n];
    (lit_at_far ? mode.far : mode.near) = amplitude / total.shape[0];
    mode.shape = total.shape;
    if (lit_at_far) {
        for (std::size_t l = 1; l < mode.shape.size(); l += 2) {
            mode.shape[l] = -mode.shape[l];
        }
    }
    return mode;
}

}  // namespace

PlanarModes match_one_exponential(const PlanarModes& solution, double thickness, bool lit_at_far,
                                  MatchedMoments moments) {
    const bool lossless = !solution.modes.empty() && std::isinf(solution.modes[0].length);
    if (lossless) {
        return {{solution.modes[0]}};  // a constant, which has no moments
    }
    const Total total = sum_up(solution.modes, 0, thickness, lit_at_far);
    if (!(total.moments[0] > 0)) {
        return {};
    }
    const std::size_t n = moments == MatchedMoments::zeroth_first ? 0 : 1;
    const double rate = rate_for(total.moments[n + 1] / total.moments[n], n, thickness);
    return {{falling_mode(total, rate, n, thickness, lit_at_far)}};
}

PlanarModes match_two_exponentials(const PlanarModes& solution, double thickness, bool lit_at_far) {
    if (solution.modes.empty()) {
        return {};
    }
    const Total others = sum_up(solution.modes, 1, thickness, lit_at_far);
    const double length = others.moments[0] / others.at_lit;
    if (!(others.at_lit > 0 && others.moments[0] > 0 && length < 0.5 * thickness &&
          length < solution.modes[0].length)) {
        return match_one_exponential(solution, thickness, lit_at_far, MatchedMoments::zeroth_first);
    }
    return {{solution.modes[0], falling_mode(others, 1 / length, 0, thickness, lit_at_far)}};
}

}  // namespace wend
