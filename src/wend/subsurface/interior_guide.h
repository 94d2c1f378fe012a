// What walks in one dense medium know about it beforehand.
#pragma once

#include <wend/medium/medium.h>
#include <wend/subsurface/half_space_mode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace wend {

/// Ways to guide a walk in a dense homogeneous medium. Each aims at an outward normal of its own, chosen by the
/// integrator, and is mixed with classical sampling.
struct InteriorGuide {
    static constexpr int most_strategies = 5;

    /// Probability of classical sampling, then of each strategy; their sum is 1, and the first is above 0.
    using Shares = std::array<float, 1 + most_strategies>;

    HomogeneousMedium medium;
    /// Modes that decay ever faster, the first not at all and the last as the medium's own; for one channel where all
    /// channels are alike, or for three.
    std::vector<std::vector<HalfSpaceMode>> modes;
    int strategies = 0;
    int lit = -1;  ///< a strategy that heads for lamps outside as well as along its mode; none if negative
    /// Whether walks can be connected to lamps where they meet the boundary, as they can if it is rough.
    bool connects_at_boundary = false;
    Shares share{1};  ///< where no others are given

    int channels() const { return static_cast<int>(modes.size()); }
    /// The mode of a channel for a decay of `steepness`, in [0, 1], times that of the last.
    int level(float steepness) const {
        const auto last = static_cast<float>(modes[0].size() - 1);
        return static_cast<int>(std::lround(std::clamp(steepness, 0.0f, 1.0f) * last));
    }
    const HalfSpaceMode& mode(int channel, int level) const {
        return modes[static_cast<std::size_t>(channel)][static_cast<std::size_t>(level)];
    }
};

/// `share_of_a` of the first, the rest of the second.
inline InteriorGuide::Shares mix(const InteriorGuide::Shares& a, const InteriorGuide::Shares& b, float share_of_a) {
    InteriorGuide::Shares result;
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = share_of_a * a[i] + (1 - share_of_a) * b[i];
    }
    return result;
}

/// A guide that mixes `strategies` of equal shares with `defensive_fraction`, in (0, 1], of classical sampling; `modes`
/// are those of the medium (subsurface/half_space_modes.h has them). Throws InputError for numbers out of range, and
/// for modes that are not as InteriorGuide has them.
InteriorGuide interior_guide(const HomogeneousMedium& medium, std::vector<std::vector<HalfSpaceMode>> modes,
                             int strategies, float defensive_fraction = 0.25f);

}  // namespace wend
