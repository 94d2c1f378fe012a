// Few exponentials in place of many: a planar adjoint that is known by its moments in depth alone.
#pragma once

#include <wend/planar/adjoint.h>

namespace wend {

/// Which moments of the true source over depth one exponential is given: both orders of the pair.
enum class MatchedMoments { zeroth_first, first_second };

/// One exponential falling from the lit side, with the given moments of `solution` over depth (counted from the lit
/// side); its dependence on direction is that of the source integrated over depth. For an isotropic half-space: length
/// <z> and amplitude ∫J/<z>, or length <z²>/(2<z>) (docs/theory/planar.md).
PlanarModes match_one_exponential(const PlanarModes& solution, double thickness, bool lit_at_far,
                                  MatchedMoments moments);

/// The longest mode of `solution` as it is, and one exponential from the lit side for all others, which keeps their sum
/// at the lit boundary and their integral. Where the others are not such a transient, match_one_exponential().
PlanarModes match_two_exponentials(const PlanarModes& solution, double thickness, bool lit_at_far);

}  // namespace wend
