// What comes of a flight through a medium.
#pragma once

#include <wend/core/colour.h>

namespace wend {

/// The outcome of a flight through a medium.
struct Flight {
    bool scatters = false;  ///< whether it ends in a collision
    float distance = 0;     ///< of the collision; the segment's length if it does not scatter
    /// What the walk multiplies its throughput by: for a collision transmittance times scattering coefficient over
    /// density, for the end of the segment transmittance over probability.
    Rgb weight;
    Rgb emitted;              ///< radiance picked up from an emissive medium on the way, before `weight`
    float glow = 0;           ///< the mean channel of `emitted`, each part over the distance it came from
    float density_ratio = 1;  ///< density over what classical sampling would have had
};

/// Adds to a flight what the medium emits at a distance.
inline void pick_up(Flight& flight, const Rgb& emitted, float distance) {
    flight.emitted += emitted;
    if (distance > 0) {
        flight.glow += mean_value(emitted) / distance;
    }
}

}  // namespace wend
