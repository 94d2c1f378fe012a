// Volume files: OpenVDB (.vdb) and NanoVDB (.nvdb), told apart by content.
#pragma once

#include <wend/core/transform.h>
#include <wend/medium/grid.h>

#include <filesystem>
#include <optional>
#include <string>

namespace wend {

/// A scalar grid of a file: the active voxels' bounding box of it. Voxel i is a sample at the index-space point i.
struct Volume {
    std::string name;
    Grid grid;
    Transform world_from_index;
    /// What is to be said about the values; empty if nothing.
    std::string warning;
};

/// Reads the grid of that name ("density", "temperature"), in single, double, half or quantized precision. Throws
/// InputError naming the file when it is missing or broken, has no such grid (the message lists those it has), or the
/// grid is not of scalars, is too large, or holds a value that is not finite or too far below 0 (NegativeValues).
/// Memory stays below most_memory() (voxel_blocks.h) for the voxels, as much for the library's tree, and the file's
/// size.
Volume read_volume(const std::filesystem::path& file, const std::string& grid_name);

/// The same for a grid that a file may lack.
std::optional<Volume> try_read_volume(const std::filesystem::path& file, const std::string& grid_name);

}  // namespace wend
