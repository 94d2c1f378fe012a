#pragma once

#include <wend/core/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <new>
#include <span>
#include <vector>

namespace wend {

/// A box of voxels, inclusive; empty where its last is below its first.
struct VoxelBox {
    Vec3i first, last;

    bool is_empty() const { return last.x < first.x || last.y < first.y || last.z < first.z; }
};

/// A scalar field sampled at integer points ("voxels") and interpolated trilinearly between them. Stored in bricks of
/// 8³ cells, of which only the occupied ones take memory; each brick repeats its neighbours' first samples (9³ values),
/// so that one look-up touches one brick. Voxels that are not stored are 0, so the field falls continuously to 0 within
/// one cell around the voxels and is 0 outside `bounds()`.
class Grid {
public:
    /// Whether the box of voxels [first, last] (inclusive) may hold anything but zeros.
    using Occupied = std::function<bool(const Vec3i& first, const Vec3i& last)>;
    /// The sample at a voxel; called only inside occupied bricks and the grid's range.
    using Value = std::function<float(int x, int y, int z)>;

    Grid() = default;

    /// The voxels first .. first + size - 1. Throws InputError if a size is not positive, a coordinate exceeds
    /// `max_coordinate`, the grid would need more than `max_bytes`, or a value is negative or not finite.
    Grid(const Vec3i& first, const Vec3i& size, const Occupied& occupied, const Value& value,
         std::size_t max_bytes = default_max_bytes);
    /// The same where boxes are known outside of which everything is 0: the work and the memory are by these, and not
    /// by the size.
    Grid(const Vec3i& first, const Vec3i& size, std::span<const VoxelBox> filled, const Value& value,
         std::size_t max_bytes = default_max_bytes);

    /// Interpolated value at a point in index space.
    float interpolate(const Vec3& p) const;
    /// The value of one of the eight voxels around p, drawn with its trilinear weight by `u` in [0,1)³: its mean is
    /// interpolate(p).
    float sample_nearest(const Vec3& p, const Vec3& u) const;

    /// The samples at the corners of the cell between a voxel and the next ones, x fastest.
    std::array<float, 8> corners(const Vec3i& voxel) const;

    /// Index-space box where the value can differ from 0: one cell more than the voxels on each side.
    const Box3& bounds() const { return bounds_; }
    Vec3i first() const { return first_; }
    Vec3i size() const { return size_; }
    float max_value() const { return max_; }
    std::size_t bytes() const;
    /// Voxels that take memory, with those that are there twice.
    std::size_t stored_voxels() const { return values_.size(); }

    /// Smallest and largest value of a part of the field.
    struct Range {
        float min = 0;
        float max = 0;
    };
    /// The values that interpolate() takes in an index-space box: exact up to rounding, whatever the box. An empty box
    /// has {0, 0}.
    Range range(const Box3& box) const;

    static constexpr std::size_t default_max_bytes = std::size_t{12} << 30;
    /// Beyond this, index-space points in single precision would not resolve a voxel's neighbourhood.
    static constexpr int max_coordinate = 1 << 20;

private:
    /// Memory that is 0 without having been written to, so that what stays 0 takes none.
    template <class T>
    struct ZeroMemory {
        using value_type = T;

        ZeroMemory() = default;
        template <class U>
        ZeroMemory(const ZeroMemory<U>&) {}
        T* allocate(std::size_t count) {
            void* const memory = std::calloc(count, sizeof(T));
            if (!memory) {
                throw std::bad_alloc();
            }
            return static_cast<T*>(memory);
        }
        void deallocate(T* memory, std::size_t) { std::free(memory); }
        void construct(T*) {}
        bool operator==(const ZeroMemory&) const = default;
    };

    static constexpr int cells_log2 = 3;
    static constexpr int cells = 1 << cells_log2;  // a brick spans 8 cells a side
    static constexpr int stride = cells + 1;       // and holds 9 samples a side
    static constexpr int brick_values = stride * stride * stride;

    // The lowest of the eight samples around a point, and where the point lies between them. No samples: the value is
    // 0.
    struct Cell {
        const float* samples = nullptr;
        float x = 0, y = 0, z = 0;

        float interpolate() const;
    };
    Cell cell_at(const Vec3& p) const;
    static Cell cell_in_brick(const float* samples, const Vec3& local);
    static Range range_in_brick(const float* samples, const Vec3& low, const Vec3& high);

    int brick_number(int bx, int by, int bz) const { return (bz * bricks_count_.y + by) * bricks_count_.x + bx; }
    const float* brick_samples(std::int32_t brick) const {
        return values_.data() + static_cast<std::size_t>(brick - 1) * brick_values;
    }
    /// All but the bricks.
    Grid(const Vec3i& first, const Vec3i& size, std::size_t max_bytes);
    std::size_t table_size() const {
        return static_cast<std::size_t>(bricks_count_.x) * bricks_count_.y * bricks_count_.z;
    }
    Vec3i first_of_brick(int number) const;
    void add_bricks(std::span<const int> numbers, const Value& value);
    void add_brick(int number, const Vec3i& first, const Value& value);

    Vec3i first_{0, 0, 0};
    Vec3i size_{0, 0, 0};
    Vec3i bricks_count_{0, 0, 0};
    Vec3 origin_{0, 0, 0};  // lower corner of bounds_, from which cells are counted
    Vec3 extent_{0, 0, 0};  // number of cells a side
    Box3 bounds_;
    float max_ = 0;
    // One more than the offset of a brick's values / brick_values; 0 where empty.
    std::vector<std::int32_t, ZeroMemory<std::int32_t>> bricks_;
    std::vector<Range> brick_ranges_;  // of the occupied bricks
    std::vector<float> values_;
};

inline float Grid::Cell::interpolate() const {
    const auto edge = [this](const float* s) { return s[0] + x * (s[1] - s[0]); };
    const auto face = [&](const float* s) {
        const float low = edge(s);
        return low + y * (edge(s + stride) - low);
    };
    const float low = face(samples);
    return low + z * (face(samples + stride * stride) - low);
}

inline Grid::Cell Grid::cell_at(const Vec3& p) const {
    const Vec3 q = p - origin_;
    // Written so that a point that is not a number is outside.
    if (!(q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x < extent_.x && q.y < extent_.y && q.z < extent_.z)) {
        return {};
    }
    const int x = static_cast<int>(q.x), y = static_cast<int>(q.y), z = static_cast<int>(q.z);
    const std::int32_t brick = bricks_[brick_number(x >> cells_log2, y >> cells_log2, z >> cells_log2)];
    if (brick == 0) {
        return {};
    }
    constexpr int within = cells - 1;
    const float* samples = brick_samples(brick) + ((z & within) * stride + (y & within)) * stride + (x & within);
    return {samples, q.x - static_cast<float>(x), q.y - static_cast<float>(y), q.z - static_cast<float>(z)};
}

inline float Grid::interpolate(const Vec3& p) const {
    const Cell cell = cell_at(p);
    return cell.samples ? cell.interpolate() : 0.0f;
}

inline float Grid::sample_nearest(const Vec3& p, const Vec3& u) const {
    const Cell cell = cell_at(p);
    if (!cell.samples) {
        return 0.0f;
    }
    const int x = u.x < cell.x, y = u.y < cell.y, z = u.z < cell.z;
    return cell.samples[(z * stride + y) * stride + x];
}

}  // namespace wend
