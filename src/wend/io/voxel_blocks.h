// What the tree-shaped volume formats have in common. Other modules use volume_file.h.
#pragma once

#include <wend/core/transform.h>
#include <wend/io/volume_file.h>

#include <filesystem>
#include <functional>
#include <memory>
#include <vector>

namespace wend {

/// Access to a tree of voxels.
struct VoxelTree {
    /// Bounding box of the active voxels.
    VoxelBox active;
    /// The nodes that may hold anything but zeros.
    std::vector<VoxelBox> filled;
    Grid::Value value;
    /// Of single-precision trees: the voxels of the leaf that begins there, z fastest, as Grid has them; null where
    /// there is none. Empty for other trees.
    Grid::InPlace leaf;
    std::shared_ptr<const float> memory;  ///< that has the leaves
    /// Index space to world.
    std::function<Imath::V3d(const Imath::V3d&)> to_world;
};

/// Copies a tree, but for leaves that can stay where they are. Throws InputError naming the file and the grid when the
/// values, the size or the map are unusable.
Volume volume_of(const VoxelTree& tree, const std::string& name, const std::filesystem::path& file);

/// What the voxels of a file may take: 512 MiB, and 256 bytes for each of the file's, which packs a leaf of one value
/// into a hundred; never more than Grid::default_max_bytes. A few tiles can stand for any number of voxels.
std::size_t most_memory(const std::filesystem::path& file);

}  // namespace wend
