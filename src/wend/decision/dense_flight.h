// Flights through the dense parts of grids, without null collisions.
#pragma once

#include <wend/decision/distance.h>
#include <wend/medium/dense_cells.h>
#include <wend/medium/majorant_grid.h>

namespace wend {

/// Whether a flight's way of that length through a majorant cell has more null collisions than are worth while, or more
/// tentative ones than floats can count. Where channels differ, any tentative collision may be one of a channel that
/// the walk does not carry.
inline bool is_too_dense(const MajorantGrid::Cell& cell, const Rgb& extinction, float length) {
    const bool grey = extinction.r == extinction.g && extinction.g == extinction.b;
    const double most = double{max_value(extinction)} * length;
    constexpr double countable = 1e30;
    return most * (cell.maximum - (grey ? cell.minimum : 0.0f)) > most_tentative_collisions ||
           most * cell.maximum > countable;
}

/// Goes on with a flight through such a cell, by exact sampling for a channel that is chosen in proportion to
/// `probability`, which is kept to what the walk carries. Adds to the flight's weight and to what it picks up, and
/// tells whether it ends in a collision there.
bool fly_densely(const GridMedium& medium, const FlightStart& start, float t_in, float t_out, Rgb& probability,
                 Flight& flight, Pcg32& random);

}  // namespace wend
