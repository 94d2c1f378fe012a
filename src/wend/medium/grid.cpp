#include <wend/core/error.h>
#include <wend/medium/grid.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <string>

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

Grid::Grid(const Vec3i& first, const Vec3i& size, std::size_t max_bytes) : first_(first), size_(size) {
    check_extent(first, size);
    const Vec3i last = first + size - Vec3i(1);
    const Vec3i cell_count = size + Vec3i(1);
    bricks_count_ = (cell_count + Vec3i(cells - 1)) / cells;
    bounds_ = Box3(Vec3(first - Vec3i(1)), Vec3(last + Vec3i(1)));
    origin_ = bounds_.min;
    extent_ = Vec3(cell_count);

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
    const std::size_t max_occupied = max_bytes / (sizeof(float) * brick_values);
    for (int number = 0; number < static_cast<int>(table_size()); ++number) {
        const Vec3i low = first_of_brick(number), high = low + Vec3i(cells);
        const Vec3i from(std::max(low.x, first.x), std::max(low.y, first.y), std::max(low.z, first.z));
        const Vec3i to(std::min(high.x, last.x), std::min(high.y, last.y), std::min(high.z, last.z));
        if (!VoxelBox{from, to}.is_empty() && occupied(from, to)) {
            if (bricks.size() == max_occupied) {
                throw_too_large(size, max_bytes);
            }
            bricks.push_back(number);
        }
    }
    add_bricks(bricks, value);
}

Grid::Grid(const Vec3i& first, const Vec3i& size, std::span<const VoxelBox> filled, const Value& value,
           std::size_t max_bytes)
    : Grid(first, size, max_bytes) {
    const std::size_t max_occupied = max_bytes / (sizeof(float) * brick_values);
    constexpr std::size_t word = 64;
    std::vector<std::uint64_t> marked(table_size() / word + 1);
    std::size_t count = 0;
    for (const VoxelBox& box : filled) {
        Vec3i from, to;
        for (int axis = 0; axis < 3; ++axis) {
            // Bricks share their outermost samples with their neighbours.
            const std::int64_t origin = std::int64_t{first[axis]} - 1;
            const std::int64_t low = std::max(box.first[axis], first[axis]) - origin;
            const std::int64_t high = std::min<std::int64_t>(box.last[axis], first[axis] + size[axis] - 1) - origin;
            from[axis] = static_cast<int>((low - 1) / cells);
            to[axis] =
                high < low ? -1 : static_cast<int>(std::min<std::int64_t>(high / cells, bricks_count_[axis] - 1));
        }
        for (int z = from.z; z <= to.z; ++z) {
            for (int y = from.y; y <= to.y; ++y) {
                for (int x = from.x; x <= to.x; ++x) {
                    const auto number = static_cast<std::size_t>(brick_number(x, y, z));
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
    add_bricks(bricks, value);
}

Vec3i Grid::first_of_brick(int number) const {
    const Vec3i brick(number % bricks_count_.x, number / bricks_count_.x % bricks_count_.y,
                      number / bricks_count_.x / bricks_count_.y);
    return first_ - Vec3i(1) + brick * cells;
}

void Grid::add_bricks(std::span<const int> numbers, const Value& value) {
    brick_ranges_.reserve(numbers.size());
    values_.reserve(numbers.size() * brick_values);
    for (const int number : numbers) {
        add_brick(number, first_of_brick(number), value);
    }
}

void Grid::add_brick(int number, const Vec3i& first, const Value& value) {
    const Vec3i end = first_ + size_;
    const std::size_t offset = values_.size();
    Range range{std::numeric_limits<float>::max(), 0};
    for (int z = first.z; z < first.z + stride; ++z) {
        for (int y = first.y; y < first.y + stride; ++y) {
            for (int x = first.x; x < first.x + stride; ++x) {
                const bool stored =
                    x >= first_.x && y >= first_.y && z >= first_.z && x < end.x && y < end.y && z < end.z;
                const float v = stored ? value(x, y, z) : 0.0f;
                if (!(v >= 0) || !std::isfinite(v)) {
                    throw InputError("voxel " + to_string(Vec3i(x, y, z)) + " holds " + std::to_string(v) +
                                     ": values must be finite and not negative");
                }
                range.min = std::min(range.min, v);
                range.max = std::max(range.max, v);
                values_.push_back(v);
            }
        }
    }
    if (range.max == 0) {
        values_.resize(offset);
        return;
    }
    brick_ranges_.push_back(range);
    bricks_[number] = static_cast<std::int32_t>(brick_ranges_.size());
    max_ = std::max(max_, range.max);
}

std::array<float, 8> Grid::corners(const Vec3i& voxel) const {
    const Vec3i q = voxel - first_ + Vec3i(1);
    std::array<float, 8> values{};
    const bool inside = q.x >= 0 && q.y >= 0 && q.z >= 0 && q.x <= size_.x && q.y <= size_.y && q.z <= size_.z;
    const std::int32_t brick = inside ? bricks_[brick_number(q.x / cells, q.y / cells, q.z / cells)] : 0;
    if (brick == 0) {
        return values;
    }
    const float* const low = brick_samples(brick) + (q.z % cells * stride + q.y % cells) * stride + q.x % cells;
    for (int i = 0; i < 8; ++i) {
        values[static_cast<std::size_t>(i)] = low[((i >> 2) * stride + (i >> 1) % 2) * stride + i % 2];
    }
    return values;
}

std::size_t Grid::bytes() const {
    return values_.size() * sizeof(float) + bricks_.size() * sizeof(std::int32_t) +
           brick_ranges_.size() * sizeof(Range);
}

Grid::Cell Grid::cell_in_brick(const float* samples, const Vec3& local) {
    const int x = std::min(static_cast<int>(local.x), cells - 1), y = std::min(static_cast<int>(local.y), cells - 1),
              z = std::min(static_cast<int>(local.z), cells - 1);
    return {samples + (z * stride + y) * stride + x, local.x - static_cast<float>(x), local.y - static_cast<float>(y),
            local.z - static_cast<float>(z)};
}

// Of a part of a brick: the extremes of a trilinear function lie at the corners of cells and of the part.
Grid::Range Grid::range_in_brick(const float* samples, const Vec3& low, const Vec3& high) {
    Range range{std::numeric_limits<float>::max(), 0};
    const Breakpoints xs(low.x, high.x), ys(low.y, high.y), zs(low.z, high.z);
    for (int k = 0; k < zs.count; ++k) {
        for (int j = 0; j < ys.count; ++j) {
            for (int i = 0; i < xs.count; ++i) {
                const float v = cell_in_brick(samples, {xs.at[i], ys.at[j], zs.at[k]}).interpolate();
                range.min = std::min(range.min, v);
                range.max = std::max(range.max, v);
            }
        }
    }
    return range;
}

Grid::Range Grid::range(const Box3& box) const {
    // Outside the bounds, and on their faces, the field is 0: the part inside has it all.
    Vec3 low, high;
    for (int axis = 0; axis < 3; ++axis) {
        low[axis] = std::max(box.min[axis], bounds_.min[axis]) - origin_[axis];
        high[axis] = std::min(box.max[axis], bounds_.max[axis]) - origin_[axis];
        if (!(low[axis] <= high[axis])) {
            return {};
        }
    }
    const auto brick_of = [](float x, int count) { return std::min(static_cast<int>(x) / cells, count - 1); };
    const Vec3i from(brick_of(low.x, bricks_count_.x), brick_of(low.y, bricks_count_.y),
                     brick_of(low.z, bricks_count_.z));
    const Vec3i to(brick_of(high.x, bricks_count_.x), brick_of(high.y, bricks_count_.y),
                   brick_of(high.z, bricks_count_.z));

    Range range{std::numeric_limits<float>::max(), 0};
    const auto include = [&range](float least, float most) {
        range.min = std::min(range.min, least);
        range.max = std::max(range.max, most);
    };
    const auto include_brick = [&](const Vec3i& b) {
        const std::int32_t brick = bricks_[brick_number(b.x, b.y, b.z)];
        if (brick == 0) {
            include(0, 0);
            return;
        }
        const Range& whole = brick_ranges_[brick - 1];
        if (whole.min >= range.min && whole.max <= range.max) {
            return;
        }
        const Vec3 corner(b * cells);
        Vec3 local_low, local_high;
        bool covered = true;
        for (int axis = 0; axis < 3; ++axis) {
            local_low[axis] = std::max(low[axis] - corner[axis], 0.0f);
            local_high[axis] = std::min(high[axis] - corner[axis], static_cast<float>(cells));
            covered = covered && local_low[axis] == 0 && local_high[axis] == cells;
        }
        if (covered) {
            include(whole.min, whole.max);
            return;
        }
        const Range part = range_in_brick(brick_samples(brick), local_low, local_high);
        include(part.min, part.max);
    };
    for (int z = from.z; z <= to.z; ++z) {
        for (int y = from.y; y <= to.y; ++y) {
            for (int x = from.x; x <= to.x; ++x) {
                include_brick({x, y, z});
            }
        }
    }
    return range;
}

}  // namespace wend
