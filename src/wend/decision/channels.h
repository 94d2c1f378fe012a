// One-sample multiple importance sampling over colour channels. A walk draws each decision for one channel, chosen with
// probability in proportion to the throughput it has gathered there; its density is then the mixture over channels.
// Step by step this equals the balance heuristic over whole walks, so no channel can receive an unbounded weight
// (docs/theory/conventions.md).
#pragma once

#include <wend/core/colour.h>

#include <algorithm>
#include <limits>

namespace wend {

/// Probability of each channel for a walk with the given throughput, which is not negative. Alike where there is none,
/// or so little that its inverse overflows.
inline Rgb channel_probabilities(const Rgb& throughput) {
    const float total = throughput.r + throughput.g + throughput.b;
    return total >= std::numeric_limits<float>::min() ? throughput / total : Rgb(1.0f / 3.0f);
}

/// Draws a channel, and rescales u to a fresh uniform number.
inline int choose_channel(const Rgb& probabilities, float& u) {
    for (int c = 0; c < 2; ++c) {
        if (u < probabilities[c]) {
            u = std::min(u / probabilities[c], 0x1.fffffep-1f);
            return c;
        }
        u -= probabilities[c];
    }
    u = probabilities.b > 0 ? std::min(std::max(u, 0.0f) / probabilities.b, 0x1.fffffep-1f) : 0.0f;
    return probabilities.b > 0 ? 2 : (probabilities.g > 0 ? 1 : 0);
}

/// The sum over the channels of their products.
constexpr float dot(const Rgb& a, const Rgb& b) {
    return a.r * b.r + a.g * b.g + a.b * b.b;
}

}  // namespace wend
