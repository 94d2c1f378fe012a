// Directions in bins of longitude and latitude: z on top, x in the middle, y to the right of it.
#pragma once

#include <wend/core/vector.h>
#include <wend/guide/path_records.h>

#include <array>
#include <vector>

namespace wend {

struct DirectionBins {
    int columns, rows;

    /// Where a direction is: column and row.
    std::array<int, 2> of(const Vec3& direction) const;
    /// In steradian, of each bin of a row.
    double solid_angle(int row) const;
};

/// In each bin, row by row, the mean over all records of the fluence that those in the bin found, over its solid angle:
/// a radiance. Zero without records.
std::vector<float> radiance_by_direction(const guide::Records& records, const DirectionBins& bins);

}  // namespace wend
