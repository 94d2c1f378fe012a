// What a walk found during an interior walk in a dense medium, and how that hangs on the ways to sample it.
#pragma once

#include <wend/core/vector.h>
#include <wend/subsurface/interior_guide.h>

#include <cstddef>

namespace wend {

/// How light that is brought changes, relatively: how much less it would be for more of each technique, and how much
/// more for a larger logarithm of the preference of NextEventSettings.
struct MixGradient {
    InteriorGuide::PerTechnique shares{};
    float preference = 0;
};

/// What a walk found during an interior walk in a dense medium and after it, up to the next.
struct InteriorWalkRecord {
    int medium = -1;  ///< none if negative
    Vec3 entry{0, 0, 0};
    bool guided = true;
    int flights = 0;
    float brought = 0;
    /// Density of each technique over that of the mixture, at the end of the interior walk or now.
    InteriorGuide::PerTechnique relative{};
    /// Sum of what was brought, times its slope.
    MixGradient slope{};
    /// Whether connections to lights from inside have succeeded: straight ones, and those that boundaries refract.
    bool connected = false;
    bool connected_through = false;

    void bring(float light, const MixGradient& relative_slope) {
        brought += light;
        for (std::size_t i = 0; i < slope.shares.size(); ++i) {
            slope.shares[i] += light * relative_slope.shares[i];
        }
        slope.preference += light * relative_slope.preference;
    }
    /// The interior walk as if it had brought that much more.
    InteriorWalkRecord times(float factor) const {
        InteriorWalkRecord result = *this;
        result.brought = 0;
        result.slope = {};
        result.bring(factor, slope);
        result.brought *= brought;
        return result;
    }
};

}  // namespace wend
