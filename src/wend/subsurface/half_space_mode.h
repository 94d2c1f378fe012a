// Directions and flights of a zero-variance walk for one exponential mode of a slab: Dwivedi's, for any phase function.
#pragma once

#include <wend/core/export.h>
#include <wend/core/random.h>
#include <wend/medium/homogeneous.h>
#include <wend/medium/phase.h>

#include <array>
#include <cstddef>
#include <span>
#include <vector>

namespace wend {

/// The light that a walk deep inside a medium may expect if it grows as exp(k h) with the height h, in mean free paths
/// along an outward normal n: from a direction of cosine mu to n, I(mu) = albedo S(mu) / (1 - k mu), and scattered to a
/// walk that arrives along mu, S(mu), which is I convolved with the phase function. The zero-variance walk draws
/// directions with the density phase function times I(after) / S(before), which is normalized, and distances with the
/// rate 1 - k mu (dwivedi1982, krivanek2014; docs/theory/subsurface.md).
class WEND_API HalfSpaceMode {
public:
    /// No preference: classical sampling.
    HalfSpaceMode() = default;
    /// `source` are the coefficients of Legendre's polynomials in S, positive on [-1, 1]; k in [0, 1), albedo and S are
    /// those of a discrete mode of the phase function that the walk is going to use.
    HalfSpaceMode(double k, double albedo, std::span<const double> source);

    /// Of flights at cosine mu to the normal: over that of the medium, positive.
    float rate(float mu) const { return 1 - k_ * mu; }
    /// By how much light grows per mean free path, in [0, 1); 0: no preference.
    float k() const { return k_; }
    /// S(mu) up to a factor.
    float source(float mu) const {
        // Every fourth power by itself: four short chains of additions instead of a long one.
        const float mu2 = mu * mu;
        const float mu4 = mu2 * mu2;
        std::array<float, stride> sums{};
        for (std::size_t i = source_.size(); i > 0; i -= stride) {
            for (std::size_t j = 0; j < stride; ++j) {
                sums[j] = sums[j] * mu4 + source_[i - stride + j];
            }
        }
        return sums[0] + mu * sums[1] + mu2 * (sums[2] + mu * sums[3]);
    }
    /// I(mu) up to the same factor.
    float radiance(float mu) const { return albedo_ * source(mu) / rate(mu); }
    /// I(-1).
    float inward_radiance() const { return inward_; }
    /// The largest radiance over the smallest.
    float contrast() const { return most_ / least_; }

    /// A direction after a collision, of density phase.evaluate(before · w) radiance(w · n) / source(before · n).
    Vec3 sample(const PhaseFunction& phase, const Vec3& before, const Vec3& normal, Pcg32& random) const;

private:
    static constexpr std::size_t stride = 4;

    float k_ = 0;
    float albedo_ = 1;
    std::vector<float> source_{1, 0, 0, 0};  // coefficients of powers of mu, as many as a multiple of the stride
    bool has_constant_source_ = true;
    float logarithm_ = 0;  // of the largest rate over the smallest
    float inward_ = 1;
    float most_ = 1;  // bounds of radiance()
    float least_ = 1;
};

/// Modes of media with this phase function from no decay (the first) to the decay of the given albedo in [0, 1] (the
/// last), evenly spaced in the rate of decay as far as diffusion theory goes. Of much absorption less is taken: such
/// modes would have a walk go straight for the boundary, and sample all else too rarely.
WEND_API std::vector<HalfSpaceMode> half_space_modes(double albedo, const PhaseFunction& phase);

/// The same for a medium, channel by channel, or for one channel where all are alike. Throws InputError for
/// coefficients that are negative or not finite.
WEND_API std::vector<std::vector<HalfSpaceMode>> half_space_modes(const HomogeneousMedium& medium);

}  // namespace wend
