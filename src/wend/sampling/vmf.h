// The von Mises–Fisher distribution of directions: the bell curve of the sphere (docs/theory/learned_field.md).
#pragma once

#include <wend/core/contracts.h>
#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/numeric/fast_math.h>

#include <algorithm>

namespace wend {

/// Directions gathered around a mean: density C(kappa) e^{kappa cos}, over solid angle (1/sr), where cos is taken with
/// the mean and C(kappa) = kappa / (4 pi sinh kappa). Concentration 0 is the uniform distribution. All formulas are
/// written in 1 - cos, the half square of the chord, and hold for concentrations from 0 to max_kappa in single
/// precision.
struct Vmf {
    /// Largest concentration: beyond it single precision cannot tell directions of the lobe apart.
    static constexpr float max_kappa = 1e5f;

    /// Unit length.
    Vec3 mean{0, 0, 1};
    /// Concentration, in [0, max_kappa].
    float kappa = 0;

    /// Density at a unit direction, in 1/sr; far outside of a narrow lobe next to 0 instead of 0.
    float density(const Vec3& direction) const;

    /// The direction belonging to a point of the unit square, [0,1)² (jakob2012).
    Vec3 sample(Vec2 u) const { return sample(u, 1 / kappa); }
    /// The same for whoever has 1 / kappa at hand; for concentration 0 it may be any number.
    Vec3 sample(Vec2 u, float inverse_kappa) const;
};

/// The density at the mean, kappa / (2 pi (1 - e^{-2 kappa})), in 1/sr.
WEND_API float vmf_peak(float kappa);

/// (1 - e^{-2 kappa}) / kappa, which is 1 / (2 pi) over the peak; relative error below 2e-6, no branch and no call.
inline float vmf_spread(float kappa) {
    const float positive = kappa > 1e-6f ? kappa : 1e-6f;
    return -fast_expm1(-2 * positive) / positive;
}

inline float Vmf::density(const Vec3& direction) const {
    return fast_exp(-0.5f * kappa * length_squared(direction - mean)) / (2 * pi * vmf_spread(kappa));
}

inline Vec3 Vmf::sample(Vec2 u, float inverse_kappa) const {
    WEND_EXPECT(u.x >= 0 && u.x < 1 && u.y >= 0 && u.y < 1);
    // Inverts the distribution of s = 1 - cos: u = (1 - e^{-kappa s}) / (1 - e^{-2 kappa}). Of all but wide lobes the
    // denominator is 1, which need not be waited for.
    constexpr float narrow = 10;
    const float all = kappa > narrow ? 1.0f : -fast_expm1(-2 * kappa);
    const float beyond = std::min(one_minus_epsilon, u.x * all);
    const float s = kappa > 1e-30f ? std::min(2.0f, -fast_log1p(-beyond) * inverse_kappa) : 2 * u.x;
    const float sine = safe_sqrt(s * (2 - s));
    const Turn azimuth = fast_turn(u.y);
    return Frame::from_z(mean).to_world({sine * azimuth.cosine, sine * azimuth.sine, 1 - s});
}

/// Mean cosine coth(kappa) - 1/kappa, in [0, 1).
WEND_API float vmf_mean_cosine(float kappa);

/// The inverse of vmf_mean_cosine: Newton's method from the start r(3 - r²)/(1 - r²) (banerjee2005). Mean cosines
/// outside [0, 1) are clamped; the result is at most Vmf::max_kappa.
WEND_API float vmf_kappa(float mean_cosine);

/// The lobe convolved by another of concentration `kappa`, approximately: the kind is not closed under convolution, but
/// mean cosines multiply exactly.
WEND_API Vmf convolve(const Vmf& lobe, float kappa);

}  // namespace wend
