// How heavy a guided walk may get.
#pragma once

#include <algorithm>

namespace wend {

/// What a guide did not foresee multiplies a walk's weight (ExpectedContribution::weight) by up to 1/classical share at
/// each decision, which over a long walk would give it a heavy tail. So the more a walk weighs, the more of its
/// decisions is classical: by none does it get heavier than this, or if it is, heavier than it is.
inline constexpr float weight_bound = 3;

/// Of the classical density, the least that a decision may have for a walk of that weight, in [0,1].
inline float least_defensive_fraction(float weight) {
    return std::min(weight / weight_bound, 1.0f);
}

}  // namespace wend
