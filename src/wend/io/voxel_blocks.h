// What the tree-shaped volume formats have in common: values in aligned blocks of 8³ voxels. Other rooms use
// volume_file.h.
#pragma once

#include <wend/core/transform.h>
#include <wend/io/volume_file.h>

#include <filesystem>
#include <functional>

namespace wend {

/// Access to a tree of voxels.
struct VoxelTree {
    Vec3i first, last;  ///< bounding box of the active voxels, inclusive
    /// Whether the aligned block of 8³ voxels around this one may hold anything but zeros.
    std::function<bool(const Vec3i& voxel)> block_occupied;
    Grid::Value value;
    /// Index space to world.
    std::function<Imath::V3d(const Imath::V3d&)> to_world;
};

/// Copies a tree. Throws InputError naming the file and the grid when the values, the size or the map are unusable.
Volume volume_of(const VoxelTree& tree, const std::string& name, const std::filesystem::path& file);

}  // namespace wend
