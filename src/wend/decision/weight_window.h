// Decision 3 by expected contribution: roulette and splitting that keep a walk near what it should bring.
#pragma once

#include <wend/core/random.h>

#include <algorithm>
#include <concepts>

namespace wend {

/// A window around the ratio of a walk's expected contribution (weight times adjoint) to the value it is estimating
/// (vorba2016). Inside it a walk goes on; below, it survives with the ratio as its probability; above, it is split into
/// as many. No roulette by weight alone: a good guide lets weights vary on purpose, and that would undo it.
struct WeightWindow {
    double low = 1.0 / 3;   ///< in (0,1]
    double high = 5.0 / 3;  ///< >= 1
    double least = 1e-3;    ///< probability of survival: an adjoint may be wrong about what it calls worthless
    int most = 64;          ///< continuations at one vertex; more only lowers the splitting

    /// Number of continuations, 1 or more with the given expectation when it splits; each one's weight is divided by
    /// `expected`.
    struct Outcome {
        int copies = 1;       ///< continuations; 0 ends the walk
        double expected = 1;  ///< their mean number, positive
    };
    /// What becomes of a walk whose ratio is this; one that is NaN or negative goes on as it is.
    Outcome sample(double ratio, Pcg32& random) const {
        return sample(ratio, [&] { return random.uniform_double(); });
    }
    /// The same by a number of [0,1) from draw(), which is asked outside of the window only.
    template <std::invocable Draw>
    Outcome sample(double ratio, const Draw& draw) const {
        if (!(ratio >= 0) || (ratio >= low && ratio <= high)) {
            return {};
        }
        const double expected = std::clamp(ratio, least, static_cast<double>(most));
        const int whole = static_cast<int>(expected);
        return {whole + (draw() < expected - whole ? 1 : 0), expected};
    }
};

/// What a guide did not foresee multiplies a walk's weight (ExpectedContribution::weight) by up to 1/classical share at
/// each decision, which over a long walk would give it a heavy tail. So the more a walk weighs, the more of its
/// decisions is classical: by none does it get heavier than this, or if it is, heavier than it is.
inline constexpr float weight_bound = 3;

/// Of the classical density, the least that a decision may have for a walk of that weight, in [0,1].
inline float least_defensive_fraction(float weight) {
    return std::min(weight / weight_bound, 1.0f);
}

}  // namespace wend
