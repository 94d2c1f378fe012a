// How a handful of values lies: for a few repetitions of an experiment, where a mean alone says little.
#pragma once

#include <cstddef>
#include <vector>

namespace wend {

/// The q-quantile, q in [0,1], of values in ascending order, linear between them (hyndman1996, type 7): q = 0.5 is the
/// median. NaN where there are none.
double quantile(const std::vector<double>& ascending, double q);

/// NaN throughout where there are no values.
struct Spread {
    std::size_t count = 0;
    double median = 0;
    double min = 0;
    double max = 0;
    double mean = 0;
    double std_error = 0;  ///< of the mean; NaN for fewer than two values, which tell nothing of it
};

/// Of the values that are finite; others are left out and not counted.
Spread spread_of(std::vector<double> values);

}  // namespace wend
