// The learned field: space divided into cells, each with a mixture of incident radiance.
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/guide/region.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace wend::guide {

struct LobeSums;

/// A kd-tree whose leaves are regions. A value: built by fit(), never changed afterwards, hence free to be read by any
/// number of threads.
class WEND_API Field {
public:
    /// As large as the other, and independent of it.
    Field(const Field& other);
    /// Leaves the other to be assigned to or destroyed, and nothing else.
    Field(Field&& other) noexcept;
    /// As the copy; regions that were found in this one are gone.
    Field& operator=(const Field& other);
    /// As the move; regions that were found in this one are gone.
    Field& operator=(Field&& other) noexcept;
    ~Field();

    /// A field that knows nothing yet about a scene of the given bounds, which must be finite and not empty.
    static Field empty(const Box3& bounds);

    /// Whether the field has learned anything.
    bool is_trained() const { return trained_; }

    /// The region of a position; null as long as the field has learned nothing. Positions outside the bounds belong to
    /// the nearest cells along the tree's planes.
    const Region* find(const Vec3& position) const;

    /// Which of the size() cells a region belongs to that find() gave.
    std::size_t index_of(const Region& region) const { return static_cast<std::size_t>(&region - regions_.data()); }

    /// What rays are told at a position; null as long as the field has learned nothing.
    const ScatteredLight* scattered_light(const Vec3& position) const {
        return trained_ ? &scattered_[nodes_[leaf_of(position)].child] : nullptr;
    }

    /// Radiance to be expected to leave a surface here towards the side of its normal; 0 as long as the field has
    /// learned nothing.
    float leaving(const Vec3& position, const Vec3& normal) const;

    /// Walks the cells that a ray crosses between t0 and t1, nearest first; the cells at the rim reach on without end.
    /// `visit(const ScatteredLight&, t_in, t_out)` returns false to stop. The intervals are not empty and leave no gap.
    /// What is left of the way on one side of a plane of the tree is not divided any more where it is no longer than
    /// `finest`: the cell in its middle stands for all of it.
    template <class Visit>
    void walk(const Ray& ray, float t0, float t1, Visit&& visit, float finest = 0) const;

    /// What the records told of each lobe of a position's cell, as seen from the region's reference point.
    std::array<LobeSums, max_lobes> lobe_sums(const Vec3& position) const;

    /// Those that it was made for: where the rim's cells end for whoever draws them.
    const Box3& bounds() const { return bounds_; }
    /// Most splits above a cell.
    static constexpr int max_depth = 64;

    /// Number of cells.
    std::size_t size() const { return regions_.size(); }
    /// Memory of the cells and of the tree.
    std::size_t bytes() const;

    /// Calls visit(bounds, region, records) for every cell: its box (at the rim cells reach on without end; the box
    /// ends at the field's bounds), what it knows, and how many records taught it, older ones counting less.
    void for_each_cell(const std::function<void(const Box3&, const Region&, double)>& visit) const;

    /// What each cell costs: its region, its memory and two nodes of the tree.
    static std::size_t bytes_per_cell();

private:
    friend class Fitting;
    friend class RecordsByCell;
    friend class ScatterFitting;
    friend class FieldBytes;

    /// An inner node has its children side by side at `child` and `child` + 1; a leaf has its region in `child`.
    struct Node {
        static constexpr std::uint32_t leaf = 3;

        float plane = 0;
        std::uint32_t axis : 2 = leaf;
        std::uint32_t child : 30 = 0;
    };
    /// As many as a node can count.
    static constexpr std::uint32_t largest_child = (1u << 30) - 1;

    /// What only fitting needs to know of a cell (field_memory.h).
    struct Memory;

    explicit Field(const Box3& bounds);

    /// The leaf of a position, as an index into nodes_.
    std::uint32_t leaf_of(const Vec3& position) const {
        std::uint32_t i = 0;
        while (nodes_[i].axis != Node::leaf) {
            i = nodes_[i].child + (position[static_cast<int>(nodes_[i].axis)] >= nodes_[i].plane ? 1 : 0);
        }
        return i;
    }

    Box3 bounds_;
    bool trained_ = false;
    std::vector<Node> nodes_;
    /// One of each per leaf, under the same index.
    std::vector<Region> regions_;
    std::vector<ScatteredLight> scattered_;
    std::vector<Memory> memories_;
};

template <class Visit>
void Field::walk(const Ray& ray, float t0, float t1, Visit&& visit, float finest) const {
    struct Part {
        std::uint32_t node;
        float t_in, t_out;
    };
    // One far side waits for each level of the tree at most.
    Part waiting[max_depth + 1];
    int count = 0;
    const Vec3 inverse(1 / ray.direction.x, 1 / ray.direction.y, 1 / ray.direction.z);
    Part part{0, t0, t1};
    for (;;) {
        const Node& node = nodes_[part.node];
        if (node.axis == Node::leaf) {
            if (part.t_in < part.t_out && !visit(scattered_[node.child], part.t_in, part.t_out)) {
                return;
            }
            if (count == 0) {
                return;
            }
            part = waiting[--count];
            continue;
        }
        const auto axis = static_cast<int>(node.axis);
        const float d = ray.direction[axis], distance = node.plane - ray.origin[axis];
        const std::uint32_t above = distance <= 0 ? 1 : 0;
        // The side of the origin comes first; the other one only where the ray gets across: along the plane it is
        // infinite or, within the plane, not a number.
        const float t = distance * inverse[axis];
        const std::uint32_t near = node.child + above, far = node.child + 1 - above;
        if (!(t > 0) || t >= part.t_out) {
            const bool starts_on_plane_and_leaves = distance == 0 && d < 0;
            part.node = starts_on_plane_and_leaves ? far : near;
        } else if (t <= part.t_in) {
            part.node = far;
        } else if (part.t_out - part.t_in <= finest) {
            part.node = t > 0.5f * (part.t_in + part.t_out) ? near : far;
        } else {
            waiting[count++] = {far, t, part.t_out};
            part = {near, part.t_in, t};
        }
    }
}

/// All that a field knows, so that field_from_bytes() gives one that answers the same, bit for bit, and learns on the
/// same. The bytes begin with a signature and a version and end with a checksum; numbers are in this machine's order.
WEND_API std::string to_bytes(const Field& field);

/// The field again. Throws InputError for bytes of another kind or version, truncated ones, or ones that were changed.
WEND_API Field field_from_bytes(std::string_view bytes);

}  // namespace wend::guide
