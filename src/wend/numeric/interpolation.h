// Values between tabulated ones.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace wend {

/// Linear between values at equal steps over [0,1], at least two of them; the ends beyond.
inline double interpolate(const std::vector<double>& values, double x) {
    const auto last = static_cast<double>(values.size() - 1);
    const double position = std::clamp(x, 0.0, 1.0) * last;
    const double below = std::min(std::floor(position), last - 1);
    const auto i = static_cast<std::size_t>(below);
    const double f = position - below;
    return (1 - f) * values[i] + f * values[i + 1];
}

}  // namespace wend
