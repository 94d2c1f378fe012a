#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/medium/grid.h>

#include <algorithm>
#include <vector>

namespace wend {

/// Bounds of a density over the cells of a coarse regular grid: what tracking needs to know of a heterogeneous medium
/// ahead of time.
class WEND_API MajorantGrid {
public:
    /// What is known of a cell.
    struct Cell {
        float minimum = 0;  ///< a lower bound
        float maximum = 0;  ///< an upper bound
        /// About the mean density in the cell, not 0 where the maximum is not: for guesses, bounds have to hold.
        float mean = 0;
    };

    MajorantGrid() = default;
    /// Covers `box` (index space of the grid) with cells of about `cell_size` voxels a side.
    MajorantGrid(const Grid& grid, const Box3& box, float cell_size);

    /// That is covered, in index space.
    const Box3& box() const { return box_; }
    /// Cells a side.
    const Vec3i& resolution() const { return resolution_; }
    /// By its place, from 0 along each axis.
    const Cell& cell(int x, int y, int z) const {
        return cells_[static_cast<std::size_t>((z * resolution_.y + y) * resolution_.x + x)];
    }
    /// Memory.
    std::size_t bytes() const { return cells_.size() * sizeof(Cell); }

    /// Walks the cells that a ray crosses between t0 and t1, nearest first (a 3-D digital differential analyser). The
    /// ray is in index space; its direction need not have unit length, so t can be a distance in the world.
    /// `visit(cell, t_in, t_out)` returns false to stop.
    template <class Visit>
    void walk(const Vec3& origin, const Vec3& direction, float t0, float t1, Visit&& visit) const;

private:
    Box3 box_;
    Vec3i resolution_{0, 0, 0};
    Vec3 cell_size_{1, 1, 1};
    Vec3 inverse_cell_size_{1, 1, 1};
    std::vector<Cell> cells_;
};

/// Where a ray (direction of any length) is inside a box: false if nowhere in [t0, t1], else t0 and t1 are narrowed to
/// it.
inline bool clip_to_box(const Box3& box, const Vec3& origin, const Vec3& direction, float& t0, float& t1) {
    for (int axis = 0; axis < 3; ++axis) {
        const float inverse = 1 / direction[axis];
        float near = (box.min[axis] - origin[axis]) * inverse;
        float far = (box.max[axis] - origin[axis]) * inverse;
        if (near > far) {
            std::swap(near, far);
        }
        // Written so that a NaN (a ray in the plane of a side) leaves the interval alone.
        t0 = near > t0 ? near : t0;
        t1 = far < t1 ? far : t1;
    }
    return t0 < t1;
}

template <class Visit>
void MajorantGrid::walk(const Vec3& origin, const Vec3& direction, float t0, float t1, Visit&& visit) const {
    if (!clip_to_box(box_, origin, direction, t0, t1)) {
        return;
    }
    int cell_index[3];
    int step[3];
    int limit[3];
    float next[3];
    float delta[3];
    for (int axis = 0; axis < 3; ++axis) {
        const float d = direction[axis];
        const float position = (origin[axis] + d * t0 - box_.min[axis]) * inverse_cell_size_[axis];
        const int c = std::clamp(static_cast<int>(position), 0, resolution_[axis] - 1);
        cell_index[axis] = c;
        if (d == 0) {
            step[axis] = 0;
            limit[axis] = -1;
            next[axis] = infinity;
            delta[axis] = infinity;
        } else {
            step[axis] = d > 0 ? 1 : -1;
            limit[axis] = d > 0 ? resolution_[axis] : -1;
            const float boundary = box_.min[axis] + static_cast<float>(c + (d > 0 ? 1 : 0)) * cell_size_[axis];
            next[axis] = (boundary - origin[axis]) / d;
            delta[axis] = cell_size_[axis] / std::abs(d);
        }
    }
    const int stride[3] = {step[0], step[1] * resolution_.x, step[2] * resolution_.x * resolution_.y};
    const Cell* current = &cell(cell_index[0], cell_index[1], cell_index[2]);
    float t = t0;
    for (;;) {
        const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
        const float t_out = std::min(next[axis], t1);
        if (t_out > t) {
            if (!visit(*current, t, t_out)) {
                return;
            }
            t = t_out;
        }
        if (next[axis] >= t1) {
            return;
        }
        cell_index[axis] += step[axis];
        if (cell_index[axis] == limit[axis]) {
            return;
        }
        current += stride[axis];
        next[axis] += delta[axis];
    }
}

}  // namespace wend
