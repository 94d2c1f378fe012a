// Mitsuba's files of volumes, `.vol`.
#pragma once

#include <wend/core/vector.h>

#include <filesystem>
#include <vector>

namespace wend::mitsuba {

/// Numbers in a box, x fastest; those of a voxel follow each other.
struct VoxelData {
    Vec3i size{1, 1, 1};
    int channels = 1;
    std::vector<float> values;
    Vec3 box_min{0, 0, 0}, box_max{1, 1, 1};  ///< where the file says that they are

    std::size_t voxels() const { return values.size() / static_cast<std::size_t>(channels); }
    float at(int x, int y, int z, int channel) const {
        const auto index = [](int i) { return static_cast<std::size_t>(i); };
        const std::size_t voxel = (index(z) * index(size.y) + index(y)) * index(size.x) + index(x);
        return values[voxel * index(channels) + index(channel)];
    }
    /// Between the voxels' middles linear, beyond the outermost ones constant; `p` in the unit cube.
    float at(const Vec3& p, int channel) const;
};

/// Reads a file of version 3 with single-precision numbers. Throws InputError naming the file if it is missing, no such
/// file, of other than 1 or 3 channels, or shorter than it says, or where a number is not finite.
VoxelData read_vol(const std::filesystem::path& file);

}  // namespace wend::mitsuba
