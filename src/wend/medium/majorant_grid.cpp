#include <wend/medium/majorant_grid.h>

#include <wend/core/contracts.h>

#include <cmath>

namespace wend {
namespace {

Vec3 floor(const Vec3& v) {
    return {std::floor(v.x), std::floor(v.y), std::floor(v.z)};
}
Vec3 ceil(const Vec3& v) {
    return {std::ceil(v.x), std::ceil(v.y), std::ceil(v.z)};
}

/// From eight points of a cell.
float mean_density(const Grid& grid, const Vec3& low, const Vec3& size, const Grid::Range& range) {
    if (range.min == range.max) {
        return range.max;
    }
    float sum = 0;
    for (int i = 0; i < 8; ++i) {
        const auto at = [i](int axis) { return (i >> axis) % 2 == 0 ? 0.25f : 0.75f; };
        sum += grid.interpolate(low + size * Vec3(at(0), at(1), at(2)));
    }
    // What the points missed may be seen by a walk all the same.
    constexpr float least_share = 0.02f;
    return std::max(sum / 8, least_share * range.max);
}

}  // namespace

MajorantGrid::MajorantGrid(const Grid& grid, const Box3& box, float cell_size) : box_(box) {
    WEND_EXPECT(cell_size > 0 && !box.isEmpty());
    const Vec3 extent = box.max - box.min;
    // A grid of little in a large box has coarser cells, so that they take no more memory than it, or little.
    const double most_cells = std::max(0x1p23, 0.25 * static_cast<double>(grid.stored_voxels()));
    const double cells = static_cast<double>(extent.x / cell_size) * (extent.y / cell_size) * (extent.z / cell_size);
    if (cells > most_cells) {
        cell_size *= static_cast<float>(std::cbrt(cells / most_cells));
    }
    for (int axis = 0; axis < 3; ++axis) {
        resolution_[axis] = std::clamp(static_cast<int>(std::ceil(extent[axis] / cell_size)), 1, 512);
        cell_size_[axis] = extent[axis] / static_cast<float>(resolution_[axis]);
        inverse_cell_size_[axis] = 1 / cell_size_[axis];
    }
    cells_.reserve(static_cast<std::size_t>(resolution_.x) * resolution_.y * resolution_.z);
    // Tracking computes positions with rounding errors: a margin keeps every look-up inside the bounds of its cell.
    constexpr float margin = 1e-3f;
    for (int z = 0; z < resolution_.z; ++z) {
        for (int y = 0; y < resolution_.y; ++y) {
            for (int x = 0; x < resolution_.x; ++x) {
                const Vec3 low =
                    box.min + Vec3(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z)) * cell_size_;
                const Vec3 high = low + cell_size_;
                // Whole voxels, since stochastic interpolation returns the value of any voxel around a point.
                const Grid::Range range = grid.range(Box3(floor(low - Vec3(margin)), ceil(high + Vec3(margin))));
                cells_.push_back({range.min, range.max, mean_density(grid, low, cell_size_, range)});
            }
        }
    }
}

}  // namespace wend
