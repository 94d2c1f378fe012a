// Pearson's chi-square test of counts.
#pragma once

#include <cstdint>
#include <span>

namespace wend {

struct ChiSquare {
    /// Sum over the cells (after pooling) of (observed - expected)² / expected; infinite when something impossible was
    /// observed.
    double statistic = 0;
    /// Cells after pooling, less one for the common total.
    int degrees_of_freedom = 0;
    /// Probability of a statistic at least this large if the expected counts are right.
    double p_value = 0;
};

/// Tests whether counts follow their expected values, which must have the same total. Cells expecting fewer than 5 are
/// pooled into one (and the next larger ones with them, until the pool expects 5), because the chi-square distribution
/// describes only well-filled cells. A count where 0 is expected is impossible: p = 0. Throws std::invalid_argument
/// when the sizes differ, when an expected value is negative or not finite, or when fewer than two cells are left,
/// since such a test could not fail.
ChiSquare chi_square_test(std::span<const std::uint64_t> observed, std::span<const double> expected);

/// Probability that a chi-square variable with this many degrees of freedom (at least 1) exceeds `statistic`.
double chi_square_p_value(double statistic, int degrees_of_freedom);

}  // namespace wend
