#include <wend/core/error.h>
#include <wend/io/voxel_blocks.h>

#include <fmt/format.h>

namespace wend {
namespace {

bool any_block_occupied(const VoxelTree& tree, const Vec3i& first, const Vec3i& last) {
    constexpr int block = 8;
    const Vec3i start(first.x & -block, first.y & -block, first.z & -block);
    for (int z = start.z; z <= last.z; z += block) {
        for (int y = start.y; y <= last.y; y += block) {
            for (int x = start.x; x <= last.x; x += block) {
                if (tree.block_occupied({x, y, z})) {
                    return true;
                }
            }
        }
    }
    return false;
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
        const bool empty = tree.last.x < tree.first.x || tree.last.y < tree.first.y || tree.last.z < tree.first.z;
        for (int axis = 0; axis < 3 && !empty; ++axis) {
            if (tree.first[axis] < -Grid::max_coordinate || tree.last[axis] >= Grid::max_coordinate) {
                throw InputError(fmt::format("voxel coordinates go from {} to {}, but must stay within {}",
                                             tree.first[axis], tree.last[axis], Grid::max_coordinate));
            }
        }
        const auto occupied = [&tree](const Vec3i& first, const Vec3i& last) {
            return any_block_occupied(tree, first, last);
        };
        Grid grid = empty ? Grid() : Grid(tree.first, tree.last - tree.first + Vec3i(1), occupied, tree.value);
        return {name, std::move(grid), affine(tree.to_world)};
    } catch (const InputError& error) {
        throw InputError(Place{file.string()}, fmt::format("grid `{}`: {}", name, error.what()));
    } catch (const std::domain_error& error) {
        throw InputError(Place{file.string()}, fmt::format("grid `{}`: its map to the world: {}", name, error.what()));
    }
}

}  // namespace wend
