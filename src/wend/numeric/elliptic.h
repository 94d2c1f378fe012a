// Elliptic integrals.
#pragma once

namespace wend {

/// The complete elliptic integral of the second kind, ∫_0^{π/2} sqrt(1 - m sin²t) dt, for a parameter m in [0, 1].
/// Relative error below 1e-14. By the arithmetic-geometric mean (abramowitz1964, section 17.6).
double elliptic_e(double m);

}  // namespace wend
