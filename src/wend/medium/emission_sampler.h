// Where a heterogeneous medium glows, as far as connections to its light need to know.
#pragma once

#include <wend/core/export.h>
#include <wend/core/transform.h>
#include <wend/core/vector.h>

#include <functional>
#include <vector>

namespace wend {

/// Draws points of a glowing medium about in proportion to what it emits there: constant over the cells of a regular
/// grid, at most 32 a side. Where it is dark at all 27 points that a cell is judged by, none is drawn.
class WEND_API EmissionSampler {
public:
    /// `box` in index space, with cells of about one voxel where the limit allows that; `emitted` is the radiance
    /// emitted per unit length at a point of the world, as a scalar, not negative.
    EmissionSampler(const Box3& box, const Transform& world_from_index,
                    const std::function<float(const Vec3&)>& emitted);

    /// A point that was drawn.
    struct Sample {
        Vec3 position;  ///< in the world
        float density;  ///< per unit volume of the world
    };
    /// `u` and `w` uniform in [0,1). Only where power() is positive.
    Sample sample(const Vec2& u, float w) const;
    /// Per unit volume, with which sample() draws a point of the world; 0 outside.
    float density(const Vec3& position) const;

    /// Radiance per unit length, integrated over the volume.
    float power() const { return power_; }
    /// The side of a cube that is about as large as the part that glows. A line through it is counted in this unit:
    /// the radiance of a point is what is emitted along one, and so densities per steradian and unit compare to those
    /// of directions, which take in all of the line.
    float unit() const { return unit_; }
    /// A density per unit volume at a point, seen from another, per steradian and unit().
    float seen_from(const Vec3& from, const Vec3& position, float density) const {
        return density * length_squared(position - from) * unit_;
    }
    /// Of what sample() draws, in the world; empty if there is none.
    Box3 bounds() const;

private:
    /// Its lowest corner, in cells.
    Vec3i place_of(std::size_t cell) const {
        const int i = static_cast<int>(cell);
        return {i % resolution_.x, i / resolution_.x % resolution_.y, i / (resolution_.x * resolution_.y)};
    }
    float probability(std::size_t cell) const { return cumulative_[cell + 1] - cumulative_[cell]; }

    Box3 box_;
    AffineMap index_from_world_, world_from_index_;
    Vec3i resolution_{0, 0, 0};
    Vec3 cell_size_{1, 1, 1};
    float cell_volume_ = 1;          ///< in the world
    std::vector<float> cumulative_;  ///< one entry more than cells, from 0 to 1
    float power_ = 0;
    float unit_ = 1;
};

}  // namespace wend
