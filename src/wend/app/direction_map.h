// What arrives at a place, by direction, as numbers.
#pragma once

#include <wend/core/vector.h>
#include <wend/film/picture.h>
#include <wend/guide/mixture.h>
#include <wend/guide/path_records.h>

#include <array>
#include <string>
#include <vector>

namespace wend {

/// Latitude-longitude maps, row by row: z on top, x in the middle, y to the right of it. Values are radiances.
struct DirectionMap {
    static constexpr int width = 512, height = 256;

    std::string name;           ///< what it shows, in words
    std::vector<float> values;  ///< width times height
};

/// Where a direction is on the maps: column and row.
std::array<int, 2> place_on_map(const Vec3& direction);

/// What the lobes say.
std::vector<float> radiance_map(const guide::VmfMixture& incident, float fluence);

/// What the records say: in each of 64 by 32 bins the mean over all records of the fluence that those in the bin
/// found, over its solid angle. Zero without records.
std::vector<float> record_map(const guide::Records& records);

/// The maps as they are: the first as colour, the others as layers of their names. There is at least one.
Picture numbers_picture(const std::vector<DirectionMap>& maps);

}  // namespace wend
