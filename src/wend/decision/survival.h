// Decision 3: how many continuations a walk has. Fewer than one is Russian roulette, more is splitting.
#pragma once

#include <wend/core/colour.h>

#include <algorithm>
#include <concepts>

namespace wend {

/// What a walk knows of itself when it decides whether to go on.
struct WalkState {
    Rgb throughput;
    /// Product of the boosts of guided directions (DirectionSample::boost): throughput times boost is what the walk
    /// would carry had it gone the same way unguided. A direction that is rich in light is drawn often and so has
    /// little weight; to end it for that would undo the guiding.
    float boost = 1;
    /// Product of the squared ratios of refractive indices passed: radiance is scaled by them on the way, its
    /// importance is not.
    float index_scale = 1;
    int depth = 0;  ///< vertices so far
};

/// Tells the expected number of continuations. (Only values up to 1 are asked of the classical walk.)
template <class D>
concept SurvivalDecision = requires(const D& d, const WalkState& state) {
    { d.expected_continuations(state) } -> std::same_as<float>;
};

/// Classical roulette: survive in proportion to the throughput that unguided directions would have left, once the walk
/// has made a start.
class ClassicalSurvival {
public:
    /// Beyond this a guide has been wrong too often to be trusted with a walk of no weight.
    static constexpr float max_boost = 1e4f;

    float expected_continuations(const WalkState& state) const {
        if (state.depth <= 1) {
            return 1;
        }
        return std::min(1.0f, max_value(state.throughput) * std::min(state.boost, max_boost) * state.index_scale);
    }
};

static_assert(SurvivalDecision<ClassicalSurvival>);

}  // namespace wend
