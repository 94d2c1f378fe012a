// The records of a pass, sorted by the cells of a field.
#pragma once

#include <wend/guide/field.h>
#include <wend/guide/path_records.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wend::guide {

/// A plane across an axis; without an axis there is none.
struct SplitPlane {
    static constexpr int no_axis = -1;

    int axis = no_axis;
    float position = 0;
};

/// The usable records, those of a cell side by side and in their order. Positions are kept at hand: cells are split
/// again and again, and records lie far apart.
class RecordsByCell {
public:
    /// Places begin, ..., end - 1.
    struct Range {
        std::size_t begin, end;

        std::size_t size() const { return end - begin; }
    };

    /// The records of a leaf, by its index among the field's nodes.
    struct Cell : Range {
        std::uint32_t node;
    };

    /// Refers to the records. `cells` has the field's cell of each (FieldBytes::cell_at), or is empty where that is not
    /// known. The order does not depend on the threads.
    RecordsByCell(const Field& field, std::span<const Record> records, std::span<const std::uint32_t> cells,
                  int threads);

    /// The leaves that have records.
    const std::vector<Cell>& cells() const { return cells_; }
    std::size_t size() const { return order_.size(); }
    /// How many have zero radiance.
    std::size_t dark() const { return dark_; }

    const Record& operator[](std::size_t place) const { return records_[order_[place].record]; }

    /// The mean position of every stride-th record.
    Imath::V3d mean_position(const Range& range, std::size_t stride) const;

    /// The plane through the mean position, across the given axis or otherwise that of largest variance, both of a
    /// regular sample of the records. None where a side would be empty.
    SplitPlane plane_across(const Range& range, int axis) const;

    /// Moves the records below the plane to the front, keeping their order; returns where the others begin.
    std::size_t partition(const Range& range, const SplitPlane& plane);

private:
    /// Of each cell, its leaf among the nodes.
    static std::vector<std::uint32_t> leaves_of(const Field& field);

    struct Entry {
        Vec3 position;
        std::uint32_t record;
    };

    std::span<const Record> records_;
    std::vector<Entry> order_;
    std::vector<Cell> cells_;
    std::size_t dark_ = 0;
};

}  // namespace wend::guide
