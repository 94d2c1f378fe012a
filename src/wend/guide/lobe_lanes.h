// A cell's lobes and the sums over its observations, side by side (lobe_fit.h).
#pragma once

#include <wend/core/vector.h>
#include <wend/guide/mixture.h>

namespace wend::guide {

/// A record as a cell sees it.
struct Observation {
    Vec3 direction;
    /// From the record's position to the cell's reference point.
    Vec3 offset;
    float inverse_distance;
    /// Relative to the mean weight of the cell's observations.
    float weight;
    /// Radiance in the first and the last colour channel over the mean of all three.
    float red = 1, blue = 1;
};

/// Lanes that are read as soon as they were written must not lie in two cache lines.
inline constexpr std::size_t cache_line = 64;

/// Lobes as seen from the reference point: their means with the axes of Frame::from_z, and what their densities are
/// made of.
struct alignas(cache_line) LobeLanes {
    Lanes x, y, z, u_x, u_y, u_z, v_x, v_y, v_z, half_kappa, log_amplitude, inverse_distance;
    int blocks;
};

/// The sums of LobeSums (statistics.h).
struct alignas(cache_line) SumLanes {
    Lanes weight, weight_square, x, y, z, offset_x, offset_y, offset_z, inverse_distance, inverse_distance_square, turn,
        spread, straight, oblique, beyond_square, red, blue;
};

}  // namespace wend::guide
