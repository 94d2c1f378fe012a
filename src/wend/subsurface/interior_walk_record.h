// What a walk found during an interior walk in a dense medium, and how that hangs on the ways to sample it.
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/subsurface/interior_guide.h>

#include <cstddef>

namespace wend {

/// How light that is brought changes, relatively: how much less it would be for more of each technique, and how much
/// more for a larger logarithm of the preference of NextEventSettings.
struct MixGradient {
    InteriorGuide::PerTechnique shares{};  ///< for more of each technique
    float preference = 0;                  ///< for a larger logarithm of the preference
};

/// Of light that a connection from a collision found: `here` are InteriorWalk::relative_densities() at the collision,
/// `towards` those of a walk that went the same way, to the boundary. Connections have the part `by_connections` of the
/// density that both ways are weighed by.
WEND_API MixGradient gradient_of_connection(const InteriorGuide::PerTechnique& here,
                                            const InteriorGuide::PerTechnique& towards, float by_connections);
/// Of light that the walk ran into, behind a collision with the relative densities `before`, and with these `now`:
/// connections that were weighed against it change less than the walk's density. `by_connections` is 0 where none
/// could have found it.
WEND_API MixGradient gradient_of_hit(const InteriorGuide::PerTechnique& before, const InteriorGuide::PerTechnique& now,
                                     float by_connections);

/// What a walk found during an interior walk in a dense medium and after it, up to the next.
struct InteriorWalkRecord {
    int medium = -1;      ///< none if negative
    Vec3 entry{0, 0, 0};  ///< where it began
    bool guided = true;   ///< whether by the guide; else TechniqueMix::unguided says how it was connected
    int flights = 0;      ///< as many as were drawn
    float brought = 0;    ///< the mean of the channels, over the throughput with which it began
    /// Density of each technique over that of the mixture, at the end of the interior walk or now.
    InteriorGuide::PerTechnique relative{};
    /// Sum of what was brought, times its slope.
    MixGradient slope{};
    /// Whether connections to lights from inside have succeeded: straight ones, and those that boundaries refract.
    bool connected = false;
    bool connected_through = false;  ///< the second

    /// Light was found: its mean over the channels, and how that changes with the mix.
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
