#include <wend/medium/grid.h>

#include <wend/core/contracts.h>
#include <wend/core/error.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace wend {
namespace {

std::string to_string(const Vec3i& v) {
    return '(' + std::to_string(v.x) + ", " + std::to_string(v.y) + ", " + std::to_string(v.z) + ')';
}

void check_extent(const Vec3i& first, const Vec3i& size) {
    for (int axis = 0; axis < 3; ++axis) {
        if (size[axis] <= 0) {
            throw InputError("a grid of " + to_string(size) + " voxels: every size must be positive");
        }
        const auto last = std::int64_t{first[axis]} + size[axis];
        if (first[axis] < -Grid::max_coordinate || last > Grid::max_coordinate) {
            throw InputError("a grid of " + to_string(size) + " voxels at " + to_string(first) +
                             ": voxel coordinates must stay within " + std::to_string(Grid::max_coordinate));
        }
    }
}

[[noreturn]] void throw_too_large(const Vec3i& size, std::size_t max_bytes) {
    throw InputError("a grid of " + to_string(size) + " voxels takes more memory than the " +
                     std::to_string(max_bytes >> 20) + " MiB allowed");
}

// Where a trilinear function of pieces of unit length can take its extremes on [low, high]: at both ends and at the
// integers between.
struct Breakpoints {
    std::array<float, 12> at;
    int count = 0;

    Breakpoints(float low, float high) {
        at[count++] = low;
        for (float x = std::floor(low) + 1; x < high; ++x) {
            at[count++] = x;
        }
        if (high > low) {
            at[count++] = high;
        }
    }
};

}  // namespace

// The table covers all voxels that a cell of the bounds touches.
Grid::Grid(const Vec3i& first, const Vec3i& size, std::size_t max_bytes) : first_(first), size_(size) {
    check_extent(first, size);
    const Vec3i last = first + size - Vec3i(1);
    bounds_ = Box3(Vec3(first - Vec3i(1)), Vec3(last + Vec3i(1)));
    origin_ = bounds_.min;
    extent_ = Vec3(size + Vec3i(1));
    for (int axis = 0; axis < 3; ++axis) {
        // Shifts round down.
        const int low = (first[axis] - 1) >> log2_side, high = (last[axis] + 1) >> log2_side;
        origin_voxel_[axis] = low * brick_side;
        bricks_count_[axis] = high - low + 1;
    }
    first_cell_ = first - Vec3i(1) - origin_voxel_;

    // The table of bricks takes memory by pages, where there is something; looking through it takes a second.
    constexpr double longest_table = 1 << 28;
    if (static_cast<double>(bricks_count_.x) * bricks_count_.y * bricks_count_.z > longest_table) {
        throw_too_large(size, max_bytes);
    }
    bricks_.resize(table_size());
}

Grid::Grid(const Vec3i& first, const Vec3i& size, const Occupied& occupied, const Value& value, std::size_t max_bytes)
    : Grid(first, size, max_bytes) {
    const Vec3i last = first + size - Vec3i(1);
    std::vector<int> bricks;
    const std::size_t max_occupied = max_bytes / (sizeof(float) * brick_voxels);
    for (int number = 0; number < static_cast<int>(table_size()); ++number) {
        const Vec3i low = origin_voxel_ + brick_at(number) * brick_side, high = low + Vec3i(brick_side - 1);
        const Vec3i from(std::max(low.x, first.x), std::max(low.y, first.y), std::max(low.z, first.z));
        const Vec3i to(std::min(high.x, last.x), std::min(high.y, last.y), std::min(high.z, last.z));
        if (!VoxelBox{from, to}.is_empty() && occupied(from, to)) {
            if (bricks.size() == max_occupied) {
                throw_too_large(size, max_bytes);
            }
            bricks.push_back(number);
        }
    }
    add_bricks(bricks, value, {}, nullptr);
}

Grid::Grid(const Vec3i& first, const Vec3i& size, std::span<const VoxelBox> filled, const Value& value,
           std::size_t max_bytes, const InPlace& in_place, std::shared_ptr<const float> memory)
    : Grid(first, size, max_bytes) {
    const std::size_t max_occupied = max_bytes / (sizeof(float) * brick_voxels);
    constexpr std::size_t word = 64;
    std::vector<std::uint64_t> marked(table_size() / word + 1);
    std::size_t count = 0;
    for (const VoxelBox& box : filled) {
        Vec3i from, to;
        for (int axis = 0; axis < 3; ++axis) {
            const int low = std::max(box.first[axis], first[axis]);
            const int high = std::min(box.last[axis], first[axis] + size[axis] - 1);
            from[axis] = (low - origin_voxel_[axis]) >> log2_side;
            to[axis] = high < low ? -1 : (high - origin_voxel_[axis]) >> log2_side;
        }
        for (int z = from.z; z <= to.z; ++z) {
            for (int y = from.y; y <= to.y; ++y) {
                for (int x = from.x; x <= to.x; ++x) {
                    const auto number = static_cast<std::size_t>((z * bricks_count_.y + y) * bricks_count_.x + x);
                    const std::uint64_t mark = std::uint64_t{1} << (number % word);
                    count += (marked[number / word] & mark) == 0;
                    marked[number / word] |= mark;
                }
            }
            if (count > max_occupied) {
                throw_too_large(size, max_bytes);
            }
        }
    }
    std::vector<int> bricks;
    bricks.reserve(count);
    for (std::size_t i = 0; i < marked.size(); ++i) {
        for (std::uint64_t rest = marked[i]; rest != 0; rest &= rest - 1) {
            bricks.push_back(static_cast<int>(i * word) + std::countr_zero(rest));
        }
    }
    add_bricks(bricks, value, in_place, std::move(memory));
}

Vec3i Grid::brick_at(int number) const {
    return {number % bricks_count_.x, number / bricks_count_.x % bricks_count_.y,
            number / bricks_count_.x / bricks_count_.y};
}

void Grid::add_bricks(std::span<const int> numbers, const Value& value, const InPlace& in_place,
                      std::shared_ptr<const float> memory) {
    const Vec3i end = first_ + size_;
    auto voxels = std::make_shared<std::vector<float>>();
    if (!in_place) {
        voxels->reserve(numbers.size() * brick_voxels);
    }
    for (const int number : numbers) {
        BrickPlace& place = bricks_[static_cast<std::size_t>(number)];
        const Vec3i low = origin_voxel_ + brick_at(number) * brick_side;
        if (const float* const there = in_place ? in_place(low) : nullptr) {
            if (std::any_of(there, there + brick_voxels, [](float v) { return v != 0; })) {
                WEND_EXPECT((there - memory.get()) % unit == 0);
                place = static_cast<BrickPlace>((there - memory.get()) / unit) + 1;
                memory_ = memory;
                ++stored_bricks_;
            }
            continue;
        }
        const std::size_t offset = voxels->size();
        bool any = false;
        for (int x = low.x; x < low.x + brick_side; ++x) {
            for (int y = low.y; y < low.y + brick_side; ++y) {
                for (int z = low.z; z < low.z + brick_side; ++z) {
                    const bool stored =
                        x >= first_.x && y >= first_.y && z >= first_.z && x < end.x && y < end.y && z < end.z;
                    const float v = stored ? value(x, y, z) : 0.0f;
                    if (!(v >= 0) || !std::isfinite(v)) {
                        throw InputError("voxel " + to_string(Vec3i(x, y, z)) + " holds " + std::to_string(v) +
                                         ": values must be finite and not negative");
                    }
                    any = any || v != 0;
                    voxels->push_back(v);
                }
            }
        }
        if (any) {
            place = -static_cast<BrickPlace>(offset / unit) - 1;
            ++stored_bricks_;
        } else {
            voxels->resize(offset);
        }
    }
    own_voxels_ = std::move(voxels);
    find_ranges(numbers);
}

// A cell belongs to the brick of its first voxel: those of a brick end at voxels of its neighbours.
void Grid::find_ranges(std::span<const int> numbers) {
    std::vector<int> touched;
    for (const int number : numbers) {
        const Vec3i brick = brick_at(number);
        for (int i = 0; i < 8; ++i) {
            const Vec3i below = brick - Vec3i(i & 1, (i >> 1) & 1, i >> 2);
            if (below.x >= 0 && below.y >= 0 && below.z >= 0) {
                touched.push_back(brick_number(below.x, below.y, below.z));
            }
        }
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    for (const int number : touched) {
        const Range range = range_of_brick(brick_at(number));
        if (range.max > 0) {
            ranges_.emplace_back(number, range);
            max_ = std::max(max_, range.max);
        }
    }
    ranges_.shrink_to_fit();
}

Grid::Range Grid::known_range(int number) const {
    const auto found = std::lower_bound(ranges_.begin(), ranges_.end(), number,
                                        [](const auto& known, int wanted) { return known.first < wanted; });
    return found != ranges_.end() && found->first == number ? found->second : Range{};
}

Grid::Range Grid::range_of_brick(const Vec3i& brick) const {
    const Vec3i from = brick * brick_side;
    // Beyond the table everything is 0.
    Range range{std::numeric_limits<float>::max(), 0};
    const Vec3i end = bricks_count_ * brick_side;
    for (int x = from.x; x <= from.x + brick_side; ++x) {
        for (int y = from.y; y <= from.y + brick_side; ++y) {
            for (int z = from.z; z <= from.z + brick_side; ++z) {
                const float v = x < end.x && y < end.y && z < end.z ? value_at(x, y, z) : 0.0f;
                range.min = std::min(range.min, v);
                range.max = std::max(range.max, v);
            }
        }
    }
    return range;
}

std::array<float, 8> Grid::corners(const Vec3i& voxel) const {
    const Vec3i q = voxel - first_ + Vec3i(1);
    const bool inside = q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x <= size_.x && q.y <= size_.y && q.z <= size_.z;
    return inside ? corners_at(voxel - origin_voxel_) : std::array<float, 8>{};
}

std::size_t Grid::bytes() const {
    return bricks_.size() * sizeof(BrickPlace) + ranges_.size() * sizeof(ranges_[0]) +
           (own_voxels_ ? own_voxels_->size() * sizeof(float) : 0);
}

// Of a part of the cells of a brick, in cells from its first: the extremes of a trilinear function lie at the corners
// of cells and of the part.
Grid::Range Grid::range_in_brick(const Vec3i& brick, const Vec3& low, const Vec3& high) const {
    Range range{std::numeric_limits<float>::max(), 0};
    const Breakpoints xs(low.x, high.x), ys(low.y, high.y), zs(low.z, high.z);
    const auto cell_of = [](float x) { return std::min(static_cast<int>(x), brick_side - 1); };
    for (int k = 0; k < zs.count; ++k) {
        for (int j = 0; j < ys.count; ++j) {
            for (int i = 0; i < xs.count; ++i) {
                const Vec3i cell(cell_of(xs.at[i]), cell_of(ys.at[j]), cell_of(zs.at[k]));
                const Place place{brick * brick_side + cell, xs.at[i] - static_cast<float>(cell.x),
                                  ys.at[j] - static_cast<float>(cell.y), zs.at[k] - static_cast<float>(cell.z)};
                const float v = interpolated(place, corners_at(place.voxel));
                range.min = std::min(range.min, v);
                range.max = std::max(range.max, v);
            }
        }
    }
    return range;
}

Grid::Range Grid::range(const Box3& box) const {
    // Outside the bounds, and on their faces, the field is 0: the part inside has it all. Counted from the table.
    Vec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
        const float shift = static_cast<float>(first_cell_[axis]);
        low[axis] = std::max(box.min[axis], bounds_.min[axis]) - origin_[axis] + shift;
        high[axis] = std::min(box.max[axis], bounds_.max[axis]) - origin_[axis] + shift;
        if (!(low[axis] <= high[axis])) {
            return {};
        }
    }
    const auto brick_of_cell = [](float x, int count) { return std::min(static_cast<int>(x) >> log2_side, count - 1); };
    // What ends where a brick begins has nothing of its cells.
    const auto last_brick = [&](float from, float to, int count) {
        const int brick = brick_of_cell(to, count);
        return to == static_cast<float>(brick * brick_side) && to > from ? brick - 1 : brick;
    };
    const Vec3i from(brick_of_cell(low.x, bricks_count_.x), brick_of_cell(low.y, bricks_count_.y),
                     brick_of_cell(low.z, bricks_count_.z));
    const Vec3i to(last_brick(low.x, high.x, bricks_count_.x), last_brick(low.y, high.y, bricks_count_.y),
                   last_brick(low.z, high.z, bricks_count_.z));

    Range range{std::numeric_limits<float>::max(), 0};
    const auto include = [&range](const Range& part) {
        range.min = std::min(range.min, part.min);
        range.max = std::max(range.max, part.max);
    };
    for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
            for (int x = from.x; x <= to.x; ++x) {
                const Vec3i brick(x, y, z);
                const Range whole = known_range(brick_number(x, y, z));
                if (whole.max == 0 || (whole.min >= range.min && whole.max <= range.max)) {
                    include({whole.max == 0 ? 0.0f : range.min, range.max});
                    continue;
                }
                const Vec3 corner(brick * brick_side);
                Vec3 local_low, local_high;
                bool covered = true;
                for (int axis = 0; axis < 3; ++axis) {
                    local_low[axis] = std::max(low[axis] - corner[axis], 0.0f);
                    local_high[axis] = std::min(high[axis] - corner[axis], static_cast<float>(brick_side));
                    covered = covered && local_low[axis] == 0 && local_high[axis] == brick_side;
                }
                include(covered ? whole : range_in_brick(brick, local_low, local_high));
            }
        }
    }
    return range;
}

}  // namespace wend
