// What walks in one dense medium know about it beforehand.
#pragma once

#include <wend/core/export.h>
#include <wend/medium/homogeneous.h>
#include <wend/subsurface/half_space_mode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace wend {

/// How to guide a walk in a dense homogeneous medium: along a mode of the tangent half-space whose outward normal the
/// walk is told, mixed with classical sampling.
struct InteriorGuide {
    /// One number each for classical and for guided sampling.
    using PerTechnique = std::array<float, 2>;

    /// What walks go through.
    HomogeneousMedium medium;
    /// Modes that decay ever faster, the first not at all and the last as the medium's own; for one channel where all
    /// channels are alike, or for three.
    std::vector<std::vector<HalfSpaceMode>> modes;
    /// Probability of classical sampling where no other is given, in (0, 1]; 1: walks are not guided.
    float defensive_fraction = 1;
    /// Whether walks head for lamps outside as well as along their mode.
    bool heads_for_emitters = false;
    /// Whether walks can be connected to lamps where they meet the boundary, as they can if it is rough.
    bool connects_at_boundary = false;

    /// Colour channels that are distinguished: 1 or 3.
    int channels() const { return static_cast<int>(modes.size()); }
    /// The mode of a channel for a decay of `steepness`, in [0, 1], times that of the last.
    int level(float steepness) const {
        const auto last = static_cast<float>(modes[0].size() - 1);
        return static_cast<int>(std::lround(std::clamp(steepness, 0.0f, 1.0f) * last));
    }
    /// A mode by its channel and its level().
    const HalfSpaceMode& mode(int channel, int level) const {
        return modes[static_cast<std::size_t>(channel)][static_cast<std::size_t>(level)];
    }
};

/// `share_of_a` of the first, the rest of the second.
inline InteriorGuide::PerTechnique mix(const InteriorGuide::PerTechnique& a, const InteriorGuide::PerTechnique& b,
                                       float share_of_a) {
    InteriorGuide::PerTechnique result;
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = share_of_a * a[i] + (1 - share_of_a) * b[i];
    }
    return result;
}

/// A guide with this probability of classical sampling, in (0, 1]; `modes` are those of the medium
/// (subsurface/half_space_mode.h has them). Throws InputError for numbers out of range, and for modes that are not as
/// InteriorGuide has them.
WEND_API InteriorGuide interior_guide(const HomogeneousMedium& medium, std::vector<std::vector<HalfSpaceMode>> modes,
                                      float defensive_fraction = 0.25f);

}  // namespace wend
