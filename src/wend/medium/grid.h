#pragma once

#include <wend/core/vector.h>

#include <cstdint>
#include <functional>
#include <vector>

namespace wend {

/// A scalar field sampled at integer points ("voxels") and interpolated trilinearly between them. Stored in bricks of 8³ cells,
/// of which only the occupied ones take memory; each brick repeats its neighbours' first samples (9³ values), so that one look-up
/// touches one brick. Outside `bounds()` the value is 0.
class Grid {
public:
    /// Whether the box of voxels [first, last] (inclusive) may hold anything but zeros.
    using Occupied = std::function<bool(const Vec3i& first, const Vec3i& last)>;
    /// The sample at a voxel; called only inside occupied bricks and the grid's range.
    using Value = std::function<float(int x, int y, int z)>;

    Grid() = default;

    /// The voxels first .. first + size - 1. Throws InputError if a size is not positive, the grid would need more than `max_bytes`,
    /// or a value is negative or not finite.
    Grid(const Vec3i& first, const Vec3i& size, const Occupied& occupied, const Value& value,
         std::size_t max_bytes = default_max_bytes);

    /// Interpolated value at a point in index space.
    float interpolate(const Vec3& p) const;
    /// The value of one of the eight voxels around p, drawn with its trilinear weight by `u` in [0,1)³: its mean is interpolate(p).
    float sample_nearest(const Vec3& p, const Vec3& u) const;

    /// Index-space box where the value can differ from 0.
    const Box3& bounds() const { return bounds_; }
    Vec3i first() const { return first_; }
    Vec3i size() const { return size_; }
    float max_value() const { return max_; }
    std::size_t bytes() const { return values_.size() * sizeof(float) + bricks_.size() * sizeof(std::int32_t); }

    /// Smallest and largest value that interpolate() takes in an index-space box.
    struct Range {
        float min = 0;
        float max = 0;
    };
    Range range(const Box3& box) const;

    static constexpr std::size_t default_max_bytes = std::size_t{12} << 30;

private:
    static constexpr int cells = 8;          // a brick spans 8 cells a side
    static constexpr int stride = cells + 1; // and holds 9 samples a side
    static constexpr int brick_values = stride * stride * stride;

    const float* brick_at(int bx, int by, int bz) const;

    Vec3i first_{0, 0, 0};
    Vec3i size_{0, 0, 0};
    Vec3i bricks_count_{0, 0, 0};
    Box3 bounds_;
    float max_ = 0;
    std::vector<std::int32_t> bricks_;  // offset of a brick's values / brick_values, or -1 where empty
    std::vector<float> values_;
};

}  // namespace wend
