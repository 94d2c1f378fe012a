#include <wend/io/voxel_blocks.h>

#include <wend/core/error.h>
#include <wend/io/negative_values.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend {
namespace {

VoxelBox common(const VoxelBox& a, const VoxelBox& b) {
    VoxelBox box;
    for (int axis = 0; axis < 3; ++axis) {
        box.first[axis] = std::max(a.first[axis], b.first[axis]);
        box.last[axis] = std::min(a.last[axis], b.last[axis]);
    }
    return box;
}

/// Where the active voxels are, but for those of value 0 that cannot change what is interpolated: a tile of these may
/// be anywhere.
VoxelBox active_box(const VoxelTree& tree) {
    constexpr int lowest = std::numeric_limits<int>::min(), highest = std::numeric_limits<int>::max();
    VoxelBox filled{Vec3i(highest), Vec3i(lowest)};
    for (const VoxelBox& box : tree.filled) {
        const VoxelBox part = common(box, tree.active);
        for (int axis = 0; axis < 3 && !part.is_empty(); ++axis) {
            filled.first[axis] = std::min(filled.first[axis], std::max(part.first[axis], lowest + 1) - 1);
            filled.last[axis] = std::max(filled.last[axis], std::min(part.last[axis], highest - 1) + 1);
        }
    }
    return common(filled, tree.active);
}

/// Whether a leaf is what a grid of these voxels has there: numbers, none below 0, and nothing outside.
bool fits(const float* leaf, const Vec3i& first, const VoxelBox& box) {
    const VoxelBox inside = common(box, {first, first + Vec3i(Grid::brick_side - 1)});
    for (int i = 0; i < Grid::brick_voxels; ++i) {
        const Vec3i at = first + Vec3i(i / (Grid::brick_side * Grid::brick_side),
                                       i / Grid::brick_side % Grid::brick_side, i % Grid::brick_side);
        const bool is_inside = at.x >= inside.first.x && at.y >= inside.first.y && at.z >= inside.first.z &&
                               at.x <= inside.last.x && at.y <= inside.last.y && at.z <= inside.last.z;
        if (!(is_inside ? leaf[i] >= 0 && std::isfinite(leaf[i]) : leaf[i] == 0)) {
            return false;
        }
    }
    return true;
}

/// The matrix of an affine map, found by applying it.
Transform affine(const std::function<Imath::V3d(const Imath::V3d&)>& map) {
    const Imath::V3d origin = map({0, 0, 0});
    Transform::Matrix m = {{0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 0}, {0, 0, 0, 1}};
    for (int column = 0; column < 3; ++column) {
        Imath::V3d unit(0);
        unit[column] = 1;
        const Imath::V3d image = map(unit) - origin;
        for (int row = 0; row < 3; ++row) {
            m[row][column] = image[row];
        }
    }
    for (int row = 0; row < 3; ++row) {
        m[row][3] = origin[row];
    }
    return Transform(m);
}

}  // namespace

Volume volume_of(const VoxelTree& tree, const std::string& name, const std::filesystem::path& file) {
    try {
        // Where no voxel is active the box is inside out, and the field is 0 everywhere.
        const VoxelBox box = active_box(tree);
        if (box.is_empty()) {
            return {name, {}, affine(tree.to_world), {}};
        }
        for (int axis = 0; axis < 3; ++axis) {
            if (box.first[axis] < -Grid::max_coordinate || box.last[axis] >= Grid::max_coordinate) {
                throw InputError(fmt::format("voxel coordinates go from {} to {}, but must stay within {}",
                                             box.first[axis], box.last[axis], Grid::max_coordinate));
            }
        }
        NegativeValues negative;
        const auto value = [&](int x, int y, int z) { return negative.raise(tree.value(x, y, z), {x, y, z}); };
        Grid::InPlace in_place;
        if (tree.leaf) {
            in_place = [&](const Vec3i& first) {
                const float* leaf = tree.leaf(first);
                return leaf && fits(leaf, first, box) ? leaf : nullptr;
            };
        }
        Grid grid(box.first, box.last - box.first + Vec3i(1), tree.filled, value, most_memory(file), in_place,
                  tree.memory);
        const std::string warning = negative.warning(grid.max_value());
        return {name, std::move(grid), affine(tree.to_world),
                warning.empty() ? "" : fmt::format("{}: grid `{}`: {}", file.string(), name, warning)};
    } catch (const InputError& error) {
        throw InputError(Place{file.string()}, fmt::format("grid `{}`: {}", name, error.what()));
    } catch (const std::domain_error& error) {
        throw InputError(Place{file.string()}, fmt::format("grid `{}`: its map to the world: {}", name, error.what()));
    }
}

std::size_t most_memory(const std::filesystem::path& file) {
    constexpr std::size_t base = std::size_t{512} << 20, per_byte = 256;
    const std::uintmax_t size = std::filesystem::file_size(file);
    return static_cast<std::size_t>(std::min<std::uintmax_t>(
        base + std::min<std::uintmax_t>(size, Grid::default_max_bytes) * per_byte, Grid::default_max_bytes));
}

}  // namespace wend
