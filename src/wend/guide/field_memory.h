// What a field remembers of each cell's records from one fit to the next.
#pragma once

#include <wend/guide/field.h>
#include <wend/guide/statistics.h>

namespace wend::guide {

/// What only fitting needs to know of a cell.
struct Field::Memory {
    std::uint32_t depth = 0;
    /// Largest distance of a record from the reference point so far.
    float radius = 0;
    /// Whether the region's reference point has been chosen.
    bool anchored = false;
    /// Records since then, older ones counting less, and of the vectors from them to the reference point and of
    /// their squares the sums.
    float located = 0;
    Vec3 offset{0, 0, 0};
    Vec3 offset_square{0, 0, 0};
    Statistics statistics;
    ScatterSums scattered;
};

}  // namespace wend::guide
