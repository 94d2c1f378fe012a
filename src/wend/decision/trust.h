// How long a walk is guided.
#pragma once

namespace wend {

/// What the guide did not foresee multiplies a walk's weight by up to 1/classical share at each decision, which over a
/// long walk would give it a heavy tail: a walk whose boosts (WalkState::boost) multiply to less than this draws
/// distances and directions unguided.
inline constexpr float least_boost = 0.05f;

}  // namespace wend
