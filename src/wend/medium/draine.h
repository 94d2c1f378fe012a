// Draine's phase function (draine2003), which fits fog and clouds (jendersie2023). Conventions as in phase.h.
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/sampling/axial_lobes.h>

#include <array>
#include <cmath>

namespace wend {

/// Henyey and Greenstein's function of `g` times 1 + alpha cosine², normalized. Of alpha = 0 it is theirs, of 1 that of
/// Cornette and Shanks, and with g = 0 Rayleigh's. `g` is not its mean cosine.
class WEND_API Draine {
public:
    /// Throws InputError unless g is in (-1, 1) and alpha in [0, largest_alpha].
    Draine(float g, float alpha);

    /// What is beyond looks alike: (1 + alpha cosine²) / alpha.
    static constexpr float largest_alpha = 1e6f;

    /// That of Henyey and Greenstein's factor, in (-1, 1).
    float g() const { return g_; }
    /// How much of cosine² there is, in [0, largest_alpha].
    float alpha() const { return alpha_; }

    /// Density per steradian.
    float evaluate(float cosine) const {
        const float d = 1 + g_ * (g_ - 2 * cosine);
        return factor_ * (1 + alpha_ * cosine * cosine) / (d * std::sqrt(d));
    }
    /// Inverts the cumulative distribution, to single precision; it grows with the cosine. u in [0,1).
    float sample_cosine(float u) const;

    /// moment(1), which is not `g`.
    float mean_cosine() const { return static_cast<float>(moment(1)); }
    /// Whether all directions are alike: both parameters are 0.
    bool is_isotropic() const { return g_ == 0 && alpha_ == 0; }
    /// The integral of the function times Legendre's polynomial of the scattering cosine.
    double moment(int degree) const;

    /// Two for each of Henyey and Greenstein's. cosh(k cosine) with cosh(k) = 1 + alpha stands for 1 + alpha cosine²:
    /// lobes that only add up cannot follow it closer. Between the directions where the ratio to the function is
    /// largest and least, it differs by a factor of 1.03 at alpha = 1, 2.5 at 40 and 7.2 at 250, beside that of the
    /// lobes of g.
    AxialLobes lobes() const;

    /// Convolved with Henyey and Greenstein's function around `mean`, as PhaseFunction::convolved(); within 1e-4.
    float convolved(const Vec3& before, const Vec3& mean) const;

private:
    float g_, alpha_;
    float total_;   ///< the integral of Henyey and Greenstein's function times 1 + alpha cosine²
    float factor_;  ///< of evaluate()
    /// Where sample_cosine() begins to search, at equal steps of u.
    static constexpr int steps = 16;
    std::array<float, steps + 1> starts_;

    float search(float u, float x) const;
};

}  // namespace wend
