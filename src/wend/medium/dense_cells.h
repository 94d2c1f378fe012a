// Exact flights through what is too dense for tracking. Between voxels the density is trilinear, so along a ray a
// cubic, and its optical depth is known in closed form: the cost is by the voxels on the way and not by what they hold.
// Tracking would make a step in proportion to the largest density around.
#pragma once

#include <wend/core/vector.h>
#include <wend/medium/grid.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {

/// A majorant cell of more tentative collisions than this on a ray's way is crossed voxel by voxel.
inline constexpr double most_tentative_collisions = 64;

/// A ray's way through one cell between eight voxels. Lengths are along the ray, in double precision: a flight may be
/// far shorter than what floats resolve.
class VoxelPassage {
public:
    /// Origin and direction are in the grid's index space; the way from `begin` to `end` must be in the voxel's cell.
    VoxelPassage(const Grid& grid, const Vec3i& voxel, const Vec3& origin, const Vec3& direction, double begin,
                 double end)
        : begin_(begin), end_(end), corners_(grid.corners(voxel)) {
        for (int axis = 0; axis < 3; ++axis) {
            slope_[axis] = double{direction[axis]};
            start_[axis] = double{origin[axis]} + slope_[axis] * begin - voxel[axis];
        }
    }

    double begin() const { return begin_; }
    double end() const { return end_; }

    /// At a distance from the beginning.
    double density(double distance) const {
        double at[3];
        for (int axis = 0; axis < 3; ++axis) {
            at[axis] = std::clamp(start_[axis] + slope_[axis] * distance, 0.0, 1.0);
        }
        const auto between = [](double a, double b, double t) { return a + t * (b - a); };
        const auto edge = [&](std::size_t i) { return between(corners_[i], corners_[i + 1], at[0]); };
        return between(between(edge(0), edge(2), at[1]), between(edge(4), edge(6), at[1]), at[2]);
    }
    /// The integral of the density from the beginning to a distance from it: by two points of Gauss's, exact for
    /// cubics.
    double depth(double distance) const {
        constexpr double low = 0.21132486540518711775, high = 0.78867513459481288225;
        return 0.5 * distance * (density(low * distance) + density(high * distance));
    }
    double depth() const { return depth(end_ - begin_); }
    /// Where on the ray the depth is reached, which must not be above depth().
    double find(double depth) const {
        double low = 0, high = end_ - begin_;
        // As far as doubles tell, also near the beginning.
        constexpr int halvings = 64;
        for (int i = 0; i < halvings; ++i) {
            const double middle = 0.5 * (low + high);
            (this->depth(middle) < depth ? low : high) = middle;
        }
        return begin_ + high;
    }

private:
    double begin_, end_;
    double start_[3], slope_[3];
    std::array<float, 8> corners_;
};

/// The passages of a ray between two distances, nearest first. `visit(passage)` returns false to stop.
template <class Visit>
void walk_voxels(const Grid& grid, const Vec3& origin, const Vec3& direction, double begin, double end, Visit&& visit) {
    const auto meets = [&](int axis, int plane) {
        return direction[axis] == 0 ? double{infinity} : (double{1} * plane - origin[axis]) / direction[axis];
    };
    Vec3i voxel;
    double next[3];
    for (int axis = 0; axis < 3; ++axis) {
        const double at = double{origin[axis]} + double{direction[axis]} * begin;
        voxel[axis] = static_cast<int>(direction[axis] < 0 ? std::ceil(at) - 1 : std::floor(at));
        next[axis] = meets(axis, voxel[axis] + (direction[axis] > 0 ? 1 : 0));
    }
    for (double t = begin; t < end;) {
        const int axis = next[0] < next[1] ? (next[0] < next[2] ? 0 : 2) : (next[1] < next[2] ? 1 : 2);
        const double out = std::min(next[axis], end);
        if (out > t) {
            if (!visit(VoxelPassage(grid, voxel, origin, direction, t, out))) {
                return;
            }
            t = out;
        }
        if (!(next[axis] < end)) {
            return;
        }
        voxel[axis] += direction[axis] > 0 ? 1 : -1;
        next[axis] = meets(axis, voxel[axis] + (direction[axis] > 0 ? 1 : 0));
    }
}

}  // namespace wend
