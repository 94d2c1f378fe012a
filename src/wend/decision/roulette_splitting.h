// Decision 3: how many continuations a walk has. Fewer than one is Russian roulette, more is splitting.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/export.h>
#include <wend/core/image.h>
#include <wend/core/random.h>

#include <algorithm>
#include <cmath>
#include <concepts>
#include <optional>
#include <vector>

namespace wend {

/// The mean of the colour channels at each pixel, row by row: averaged over a square of neighbours, the smaller the
/// more samples a pixel has had, and kept above a tenth of the picture's mean, as the relative error is measured. Zero
/// everywhere as long as the picture is black.
WEND_API std::vector<float> pixel_estimates(const Image& picture, int samples);

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

/// What a walk knows of itself when it decides whether to go on.
struct WalkState {
    /// What the walk carries: the product of all weights so far.
    Rgb throughput;
    /// Product of the density ratios of guided directions (DirectionSample::density_ratio): throughput times
    /// density_ratio is what the walk would carry had it gone the same way unguided. A direction that is rich in light
    /// is drawn often and so has little weight; to end it for that would undo the guiding.
    float density_ratio = 1;
    /// Product of the squared ratios of refractive indices passed: radiance is scaled by them on the way, its
    /// importance is not.
    float index_scale = 1;
    int depth = 0;  ///< vertices so far
    /// Nothing is known of what to expect here, at a mirror or a boundary that refracts, but elsewhere.
    bool is_judged_elsewhere = false;
    bool in_volume = false;  ///< whether the last vertex is a collision
};

/// What is known of a walk at a vertex before its direction is drawn.
struct ExpectedContribution {
    /// The walk's expected contribution from here on, over the value that it estimates.
    std::optional<float> ratio;
    /// What the walk carries over what it began with: the throughput's mean over the channels, times
    /// WalkState::index_scale.
    float weight = 1;
    int split_capacity = 1;  ///< for continuations, at least 1

    /// At a vertex with this albedo and distribution of directions, of a walk with this throughput that estimates a
    /// `value` (a pixel's; 0: not known): the ratio is none where either of the two knows nothing.
    template <class Distribution>
    static ExpectedContribution at(const Distribution& directions, const Rgb& albedo, const Rgb& throughput,
                                   float value, int split_capacity) {
        ExpectedContribution expected{std::nullopt, mean_value(throughput), split_capacity};
        if (const auto light = directions.in_scattered(); light && value > 0) {
            expected.ratio = mean_value(throughput * albedo * *light) / value;
        }
        return expected;
    }
};

/// Is asked twice at a vertex. `before_direction`: how many directions to draw; nothing if that is to be judged by the
/// weight, once a direction is drawn. Then `after_direction` tells the probability of going on, at most 1.
template <class D>
concept RouletteSplittingDecision = requires(const D& d, const ExpectedContribution& expected, Pcg32& random,
                                             const WalkState& state) {
    { d.before_direction(expected, random) } -> std::same_as<std::optional<WeightWindow::Outcome>>;
    { d.after_direction(state) } -> std::same_as<float>;
};

/// Classical roulette: survive in proportion to the throughput that unguided directions would have left, once the walk
/// has made a start and has less than `ends_below` of it.
class ClassicalRoulette {
public:
    /// Ends walks as absorption would, from their first loss on.
    constexpr ClassicalRoulette() = default;
    /// `ends_below` in (0,1]. `media_absorb`: whether after collisions walks end as absorption would nonetheless.
    constexpr explicit ClassicalRoulette(float ends_below, bool media_absorb = false)
        : ends_below_(ends_below), media_absorb_(media_absorb) {}

    /// Beyond this a guide has been wrong too often to be trusted with a walk of no weight.
    static constexpr float max_density_ratio = 1e4f;

    /// Nothing: it always judges by the weight, once a direction is drawn.
    std::optional<WeightWindow::Outcome> before_direction(const ExpectedContribution& /*expected*/,
                                                          Pcg32& /*random*/) const {
        return std::nullopt;
    }
    /// Probability of going on; 1 up to the first vertex.
    float after_direction(const WalkState& state) const {
        if (state.depth <= 1) {
            return 1;
        }
        const float ends_below = media_absorb_ && state.in_volume ? 1.0f : ends_below_;
        return std::min(1.0f, max_value(state.throughput) * std::min(state.density_ratio, max_density_ratio) *
                                  state.index_scale / ends_below);
    }

    /// As it was made.
    constexpr float ends_below() const { return ends_below_; }
    /// As it was made.
    constexpr bool media_absorb() const { return media_absorb_; }

private:
    float ends_below_ = 1;
    bool media_absorb_ = false;
};

/// Classical roulette of a walk that is not guided yet. To survive in proportion to the throughput is cheap but noisy:
/// in rooms a half is up to 1.6 times more efficient. In media of high albedo each collision loses little, and walks
/// would get much longer (docs/experiments/survival.md).
inline constexpr ClassicalRoulette unguided_walks_end{0.5f, true};

/// Classical roulette of a guided walk. It is on its way to light, and to end it at its first losses would be a noise
/// that its directions had just avoided. An eighth is a compromise over several scenes (docs/experiments/survival.md).
inline constexpr ClassicalRoulette guided_walks_end{1.0f / 8};

/// Roulette and splitting by expected contribution (vorba2016), classical roulette where it is not known. Of walks that
/// are judged elsewhere that ends but the worthless: what it lets through would come back with many times its weight.
///
/// A walk gets heavier than it began only on ways that were drawn less often than scattering would have it, since
/// little was expected of them; should they lead to light all the same, it stands out. So the window's upper edge holds
/// for its weight too, known contribution or not. As weights do not grow in the mean, few walks are so heavy.
class AdjointRouletteSplitting {
public:
    /// With either of the two off, its side of the window is open. `sample_variance`: of one sample of a pixel,
    /// relative and as a mean over the picture, >= 0.
    ///
    /// Where it is low, roulette is reluctant. By rath2022 the probability that pays best follows the root of what the
    /// rest of a walk has in second moment, over cost, relative to what a sample has in variance. The second
    /// moment of a sample is 1 + V; taking its rest to have it too, all else being equal, leaves sqrt((1 + V) / V).
    AdjointRouletteSplitting(bool roulette, bool splitting, double sample_variance)
        : roulette_(roulette), splitting_(splitting) {
        window_.low *= std::max(least_roulette, 1 / std::sqrt(1 + 1 / sample_variance));
    }

    /// How many directions to draw; nothing where neither expected contribution nor weight calls for a decision here.
    std::optional<WeightWindow::Outcome> before_direction(const ExpectedContribution& expected, Pcg32& random) const {
        return before_direction(expected, [&] { return random.uniform_double(); });
    }
    /// The same by a number of [0,1) from draw(), which is asked only where something is left to chance.
    template <std::invocable Draw>
    std::optional<WeightWindow::Outcome> before_direction(const ExpectedContribution& expected,
                                                          const Draw& draw) const {
        std::optional<float> ratio = expected.ratio;
        if (splitting_ && expected.weight > window_.high) {
            ratio = std::max(expected.weight, ratio.value_or(0));
        }
        if (!ratio || (*ratio < window_.low && !roulette_) || (*ratio > window_.high && !splitting_)) {
            return std::nullopt;
        }
        WeightWindow window = window_;
        window.most = std::min(window.most, expected.split_capacity);
        return window.sample(*ratio, draw);
    }
    /// Probability of going on by weight alone, for where before_direction() had nothing to say.
    float after_direction(const WalkState& state) const {
        return (roulette_ && state.is_judged_elsewhere ? worthless_walks_end_ : guided_walks_end)
            .after_direction(state);
    }

private:
    /// Where there is no noise, walks have to end all the same.
    static constexpr double least_roulette = 0.1;

    bool roulette_, splitting_;
    /// An estimate learned from noise calls too much worthless: what survives a less likely roulette would stand out.
    /// And an end saves little: half the width of window below, in logarithms, was more efficient on six of eight
    /// scenes (docs/experiments/survival.md).
    WeightWindow window_{.low = 1.0 / 6, .least = 0.5};
    ClassicalRoulette worthless_walks_end_{1e-4f};
};

static_assert(RouletteSplittingDecision<ClassicalRoulette>);
static_assert(RouletteSplittingDecision<AdjointRouletteSplitting>);

}  // namespace wend
