// Legendre's polynomials.
#pragma once

#include <cstddef>
#include <span>

namespace wend {

/// Fills values with P_0(x), P_1(x), ... by their recurrence, stable for |x| <= 1.
inline void legendre_polynomials(double x, std::span<double> values) {
    double before = 0;
    double value = 1;
    for (std::size_t n = 0; n < values.size(); ++n) {
        values[n] = value;
        const auto degree = static_cast<double>(n);
        const double next = ((2 * degree + 1) * x * value - degree * before) / (degree + 1);
        before = value;
        value = next;
    }
}

}  // namespace wend
