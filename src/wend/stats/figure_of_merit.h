#pragma once

#include <wend/stats/moments.h>

#include <optional>

namespace wend {

/// Efficiency of an estimator: 1 / (relative_error² · seconds), in 1/s, with seconds summed over threads. It does not
/// depend on how long the estimator ran, so it compares estimators at unequal cost. Absent when the variance is 0
/// (nothing is left to improve) or no time was spent.
inline std::optional<double> figure_of_merit(const Moments& moments, double seconds) {
    const double error = moments.relative_error();
    if (error == 0 || seconds <= 0) {
        return std::nullopt;
    }
    return 1.0 / (error * error * seconds);
}

}  // namespace wend
