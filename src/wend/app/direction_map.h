// What arrives at a place, by direction, as a picture.
#pragma once

#include <wend/film/picture.h>
#include <wend/guide/mixture.h>
#include <wend/guide/records.h>

#include <vector>

namespace wend {

/// Latitude-longitude maps, row by row: z on top, x in the middle. Values are radiances.
struct DirectionMaps {
    static constexpr int width = 512, height = 256;

    std::vector<float> radiance;
    std::vector<float> records;  ///< may be empty
};

/// What the lobes say.
std::vector<float> radiance_map(const guide::VmfMixture& incident, float fluence);

/// What the records say: in each of 64 by 32 bins the mean over all records of the fluence that those in the bin
/// found, over its solid angle. Zero without records.
std::vector<float> record_map(const guide::Records& records);

/// The maps as they are: the records' is the layer "records".
Picture numbers_picture(const DirectionMaps& maps);

/// In false colours over four decades below the largest radiance, a mark at the mean of each lobe; the records' map is
/// below, in the same colours.
Picture colours_picture(const DirectionMaps& maps, const guide::VmfMixture& incident);

}  // namespace wend
