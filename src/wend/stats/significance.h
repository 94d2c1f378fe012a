// When an estimate agrees with what it should be.
#pragma once

#include <wend/stats/moments.h>

namespace wend {

/// Whether an estimate lies within its own noise and rounding of a reference:
/// |mean - reference| <= z * standard_error + rounding * |reference|.
/// `rounding` is relative and stands for the arithmetic alone (a few epsilons of the type computed in). The variance
/// has no floor: a floor lets a dark estimate be arbitrarily wrong, and a zero-variance one needs only the rounding
/// term.
bool agrees(double mean, double standard_error, double reference, double z, double rounding = 1e-12);

/// The same for the mean of the given values.
bool agrees(const Moments& moments, double reference, double z, double rounding = 1e-12);

/// Probability that a standard normal variable is at least |z| away from 0.
double two_sided_p_value(double z);

/// The significance at which each of `tests` independent tests must be held so that all together reject a true
/// hypothesis with the given probability: 1 - (1 - significance)^(1/tests) (sidak1967). Significance in (0, 1), tests
/// at least 1.
double sidak(double significance, int tests);

}  // namespace wend
