// Decision 3: how many continuations a walk has. Fewer than one is Russian roulette, more is splitting.
#pragma once

#include <wend/core/colour.h>

#include <algorithm>
#include <concepts>

namespace wend {

/// What a walk knows of itself when it decides whether to go on.
struct WalkState {
    Rgb throughput;
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

/// Classical roulette: survive in proportion to the throughput, once the walk has made a start.
class ClassicalSurvival {
public:
    float expected_continuations(const WalkState& state) const {
        if (state.depth <= 1) {
            return 1;
        }
        return std::min(1.0f, max_value(state.throughput) * state.index_scale);
    }
};

static_assert(SurvivalDecision<ClassicalSurvival>);

}  // namespace wend
