// Functions on the unit square by tables, bilinear between their entries, and densities in proportion to them.
#pragma once

#include <wend/core/vector.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <tuple>
#include <utility>
#include <vector>

namespace wend {

/// A convex combination of up to four slices of a table.
struct SliceBlend {
    std::array<std::size_t, 4> slice{};
    std::array<float, 4> weight{1, 0, 0, 0};
    std::size_t count = 1;

    /// The blend of what `of(slice)` returns.
    template <class Of>
    auto mixed(const Of& of) const {
        auto sum = of(slice[0]) * weight[0];
        for (std::size_t i = 1; i < count; ++i) {
            sum += of(slice[i]) * weight[i];
        }
        return sum;
    }
};

/// Where a point lies between the entries of a table.
struct BilinearCell {
    std::size_t column, row;
    float x, y;  ///< within the cell, in [0, 1]

    BilinearCell(const Vec2& p, std::size_t width, std::size_t height) {
        std::tie(column, x) = split(p.x, width);
        std::tie(row, y) = split(p.y, height);
    }

private:
    static std::pair<std::size_t, float> split(float p, std::size_t entries) {
        const float place = std::clamp(p, 0.0f, 1.0f) * static_cast<float>(entries - 1);
        const std::size_t cell = std::min(static_cast<std::size_t>(place), entries - 2);
        return {cell, place - static_cast<float>(cell)};
    }
};

/// Slices of height x width values each, the first and last of which are on the sides of the unit square; x runs
/// fastest. Width and height are at least 2.
template <class Value>
struct BilinearTable {
    std::size_t width = 2;
    std::size_t height = 2;
    std::vector<Value> values;

    std::size_t slices() const { return values.size() / (width * height); }
    const Value& entry(std::size_t slice, std::size_t column, std::size_t row) const {
        return values[(slice * height + row) * width + column];
    }
    Value at(const SliceBlend& blend, const Vec2& p) const {
        const BilinearCell c(p, width, height);
        return blend.mixed([&](std::size_t s) {
            const Value below = entry(s, c.column, c.row) * (1 - c.x) + entry(s, c.column + 1, c.row) * c.x;
            const Value above = entry(s, c.column, c.row + 1) * (1 - c.x) + entry(s, c.column + 1, c.row + 1) * c.x;
            return below * (1 - c.y) + above * c.y;
        });
    }
};

/// Densities on the unit square, bilinear between the entries of a table; blends of slices are densities, too.
class BilinearDensity {
public:
    /// In proportion to each slice of values that are finite and not negative. A slice of zeros counts as even.
    explicit BilinearDensity(BilinearTable<float> table);

    struct Point {
        Vec2 position;
        float density = 0;  ///< where the point is drawn
    };
    /// From a uniform point of the unit square: its row first, then its column.
    Point sample(const SliceBlend& blend, const Vec2& u) const;
    /// The uniform point that sample() turns into `p`, and the density of `p`.
    Point invert(const SliceBlend& blend, const Vec2& p) const;
    float density(const SliceBlend& blend, const Vec2& p) const { return table_.at(blend, p); }

private:
    /// Integral over x from the left side to an entry, along a row of entries.
    double to_column(const SliceBlend& blend, std::size_t column, std::size_t row) const;
    /// Integral over all x, and over y from below to a row of entries.
    double to_row(const SliceBlend& blend, std::size_t row) const;
    double value(const SliceBlend& blend, std::size_t column, std::size_t row) const;

    BilinearTable<float> table_;   // whose slices have integral 1
    std::vector<double> columns_;  // entry by entry
    std::vector<double> rows_;     // slice by slice, by row
};

}  // namespace wend
