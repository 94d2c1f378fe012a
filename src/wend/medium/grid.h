#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <functional>
#include <memory>
#include <new>
#include <span>
#include <utility>
#include <vector>

namespace wend {

/// A box of voxels, inclusive; empty where its last is below its first.
struct VoxelBox {
    Vec3i first;  ///< the voxel of least coordinates
    Vec3i last;   ///< the opposite one

    /// Whether there is no voxel in it.
    bool is_empty() const { return last.x < first.x || last.y < first.y || last.z < first.z; }
};

/// A scalar field sampled at integer points ("voxels") and interpolated trilinearly between them. Stored in bricks of
/// 8³ voxels, of which only the occupied ones take memory. Voxels that are not stored are 0, so the field falls
/// continuously to 0 within one cell around the voxels and is 0 outside `bounds()`. Copies share the voxels.
class WEND_API Grid {
public:
    /// Voxels along the side of a brick, whose first one has coordinates that are multiples of it.
    static constexpr int brick_side = 8;
    /// All voxels of a brick.
    static constexpr int brick_voxels = brick_side * brick_side * brick_side;

    /// Whether the box of voxels [first, last] (inclusive) may hold anything but zeros.
    using Occupied = std::function<bool(const Vec3i& first, const Vec3i& last)>;
    /// The sample at a voxel; called only inside occupied bricks and the grid's range.
    using Value = std::function<float(int x, int y, int z)>;
    /// The voxels of the brick that begins at `first` if they lie in memory already, as they are to be: z fastest, then
    /// y; null otherwise. They must all be finite and not negative, and those outside of the grid's range 0.
    using InPlace = std::function<const float*(const Vec3i& first)>;

    Grid() = default;

    /// The voxels first .. first + size - 1. Throws InputError if a size is not positive, a coordinate exceeds
    /// `max_coordinate`, the grid would need more than `max_bytes`, or a value is negative or not finite.
    Grid(const Vec3i& first, const Vec3i& size, const Occupied& occupied, const Value& value,
         std::size_t max_bytes = default_max_bytes);
    /// The same where boxes are known outside of which everything is 0: the work and the memory are by these, and not
    /// by the size. What `in_place` has, which may be empty, is in `memory` and stays there.
    Grid(const Vec3i& first, const Vec3i& size, std::span<const VoxelBox> filled, const Value& value,
         std::size_t max_bytes = default_max_bytes, const InPlace& in_place = {},
         std::shared_ptr<const float> memory = nullptr);

    /// Interpolated value at a point in index space.
    float interpolate(const Vec3& p) const;
    /// The value of one of the eight voxels around p, drawn with its trilinear weight by `u` in [0,1)³: its mean is
    /// interpolate(p).
    float sample_nearest(const Vec3& p, const Vec3& u) const;

    /// The samples at the corners of the cell between a voxel and the next ones, x fastest.
    std::array<float, 8> corners(const Vec3i& voxel) const;

    /// Index-space box where the value can differ from 0: one cell more than the voxels on each side.
    const Box3& bounds() const { return bounds_; }
    /// The voxel of least coordinates.
    Vec3i first() const { return first_; }
    /// Voxels a side.
    Vec3i size() const { return size_; }
    /// The largest value.
    float max_value() const { return max_; }
    /// Memory of its own; that of bricks which lie elsewhere is their owner's.
    std::size_t bytes() const;
    /// Voxels of all occupied bricks.
    std::size_t stored_voxels() const { return stored_bricks_ * brick_voxels; }

    /// Smallest and largest value of a part of the field.
    struct Range {
        float min = 0;  ///< the smallest
        float max = 0;  ///< the largest
    };
    /// The values that interpolate() takes in an index-space box: exact up to rounding, whatever the box. An empty box
    /// has {0, 0}.
    Range range(const Box3& box) const;

    /// What a grid may take unless it is said otherwise.
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

    static constexpr int log2_side = 3;
    static_assert(1 << log2_side == brick_side);
    // From a voxel to the next one within a brick.
    static constexpr int x_step = brick_side * brick_side, y_step = brick_side, z_step = 1;

    // Where the voxels of a brick are: 0 nowhere, since all of them are 0; above 0 one more than their place in
    // `memory_`, in units of so many floats; below 0 the same in `own_voxels_`, with the other sign.
    using BrickPlace = std::int32_t;
    static constexpr int unit = 8;
    static_assert(brick_voxels % unit == 0);

    // The cell around a point: its first voxel, counted from that of the table of bricks, and where the point lies in
    // it.
    struct Place {
        Vec3i voxel;
        float x, y, z;
    };
    // False outside of the bounds.
    bool place_of(const Vec3& p, Place& place) const;
    static float interpolated(const Place& place, const std::array<float, 8>& corners);

    int brick_number(int bx, int by, int bz) const { return (bz * bricks_count_.y + by) * bricks_count_.x + bx; }
    // Of the brick around a voxel, which is counted from that of the table; null where all are 0.
    const float* brick_around(int x, int y, int z) const {
        const BrickPlace place =
            bricks_[static_cast<std::size_t>(brick_number(x >> log2_side, y >> log2_side, z >> log2_side))];
        if (place == 0) {
            return nullptr;
        }
        return place > 0 ? memory_.get() + std::size_t{unit} * static_cast<std::size_t>(place - 1)
                         : own_voxels_->data() + std::size_t{unit} * static_cast<std::size_t>(-(place + 1));
    }
    static int index_in_brick(int x, int y, int z) {
        constexpr int within = brick_side - 1;
        return (x & within) * x_step + (y & within) * y_step + (z & within) * z_step;
    }
    // Of a voxel counted from that of the table, which may be one beyond it.
    float value_at(int x, int y, int z) const;
    std::array<float, 8> corners_at(const Vec3i& voxel) const;

    Grid(const Vec3i& first, const Vec3i& size, std::size_t max_bytes);
    std::size_t table_size() const {
        return static_cast<std::size_t>(bricks_count_.x) * bricks_count_.y * bricks_count_.z;
    }
    Vec3i brick_at(int number) const;
    void add_bricks(std::span<const int> numbers, const Value& value, const InPlace& in_place,
                    std::shared_ptr<const float> memory);
    void find_ranges(std::span<const int> numbers);
    Range known_range(int number) const;
    Range range_of_brick(const Vec3i& brick) const;
    Range range_in_brick(const Vec3i& brick, const Vec3& low, const Vec3& high) const;

    Vec3i first_{0, 0, 0};
    Vec3i size_{0, 0, 0};
    Vec3i origin_voxel_{0, 0, 0};  // where the table of bricks begins
    Vec3i bricks_count_{0, 0, 0};
    Vec3i first_cell_{0, 0, 0};  // the lower corner of bounds_, counted from origin_voxel_
    Vec3 origin_{0, 0, 0};       // the same in index space
    Vec3 extent_{0, 0, 0};       // number of cells a side
    Box3 bounds_;
    float max_ = 0;
    std::size_t stored_bricks_ = 0;
    std::vector<BrickPlace, ZeroMemory<BrickPlace>> bricks_;
    /// Of the cells that begin in a brick, by its number, in order: of those where some are not 0.
    std::vector<std::pair<int, Range>> ranges_;
    std::shared_ptr<const std::vector<float>> own_voxels_;
    std::shared_ptr<const float> memory_;
};

inline bool Grid::place_of(const Vec3& p, Place& place) const {
    const Vec3 q = p - origin_;
    // Written so that a point that is not a number is outside.
    if (!(q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x < extent_.x && q.y < extent_.y && q.z < extent_.z)) {
        return false;
    }
    const Vec3i cell(static_cast<int>(q.x), static_cast<int>(q.y), static_cast<int>(q.z));
    place = {cell + first_cell_, q.x - static_cast<float>(cell.x), q.y - static_cast<float>(cell.y),
             q.z - static_cast<float>(cell.z)};
    return true;
}

inline float Grid::value_at(int x, int y, int z) const {
    const float* const voxels = brick_around(x, y, z);
    return voxels ? voxels[index_in_brick(x, y, z)] : 0.0f;
}

inline std::array<float, 8> Grid::corners_at(const Vec3i& v) const {
    constexpr int last = brick_side - 1;
    if ((v.x & last) != last && (v.y & last) != last && (v.z & last) != last) {
        const float* const voxels = brick_around(v.x, v.y, v.z);
        if (!voxels) {
            return {};
        }
        const float* const s = voxels + index_in_brick(v.x, v.y, v.z);
        return {s[0],      s[x_step],          s[y_step],          s[x_step + y_step],
                s[z_step], s[x_step + z_step], s[y_step + z_step], s[x_step + y_step + z_step]};
    }
    return {value_at(v.x, v.y, v.z),         value_at(v.x + 1, v.y, v.z),        value_at(v.x, v.y + 1, v.z),
            value_at(v.x + 1, v.y + 1, v.z), value_at(v.x, v.y, v.z + 1),        value_at(v.x + 1, v.y, v.z + 1),
            value_at(v.x, v.y + 1, v.z + 1), value_at(v.x + 1, v.y + 1, v.z + 1)};
}

inline float Grid::interpolated(const Place& place, const std::array<float, 8>& c) {
    const auto edge = [&](std::size_t i) { return c[i] + place.x * (c[i + 1] - c[i]); };
    const auto face = [&](std::size_t i) {
        const float low = edge(i);
        return low + place.y * (edge(i + 2) - low);
    };
    const float low = face(0);
    return low + place.z * (face(4) - low);
}

inline float Grid::interpolate(const Vec3& p) const {
    Place place;
    return place_of(p, place) ? interpolated(place, corners_at(place.voxel)) : 0.0f;
}

inline float Grid::sample_nearest(const Vec3& p, const Vec3& u) const {
    Place place;
    if (!place_of(p, place)) {
        return 0.0f;
    }
    return value_at(place.voxel.x + (u.x < place.x), place.voxel.y + (u.y < place.y), place.voxel.z + (u.z < place.z));
}

}  // namespace wend
