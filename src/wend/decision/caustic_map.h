// Light that smooth surfaces lead to a place, as photons tell of it: one more way to draw directions.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/sampling/vmf.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace wend {

/// What a photon tells of the place where it arrived.
struct CausticLobe {
    Vec3 position{0, 0, 0};  ///< of that place, in scene units
    Vec3 towards{0, 0, 1};   ///< where it came from, unit length
    float distance = 0;      ///< of the light, along the way
    Rgb light;               ///< the photon's flux, or what is in proportion to it
};

/// CausticLobes by place: cells of a few that arrived next to each other, in groups of similar directions, of which
/// each is mostly one way to one light.
class WEND_API CausticMap {
public:
    /// Most groups of a cell.
    static constexpr std::size_t most_groups = 8;

    /// Mostly one way to one light.
    struct Group {
        Vmf lobe;             ///< of directions, seen from its place
        Vec3 place{0, 0, 0};  ///< where it arrived, as a mean
        Vec3 image{0, 0, 0};  ///< where its light would be if all mirrors were plane
        float turn = 0;       ///< by how much directions turn away from a step aside, in 1/length
        float distance = 0;   ///< of its light, along the way
        Rgb light;            ///< sum over its caustic lobes

        /// Where its light comes from, as seen from a position.
        Vec3 direction(const Vec3& position) const { return normalize(lobe.mean - (position - place) * turn); }
    };

    /// Caustic lobes that arrived next to each other.
    struct Cell {
        Box3 reach;                             ///< where it has something to say
        Vec3 extent;                            ///< of the space that its caustic lobes lie in
        float light = 0;                        ///< of bright groups, as a mean over channels
        std::size_t count = 0;                  ///< of groups
        std::size_t bright = 0;                 ///< groups that are worth drawing from; these come first
        std::array<Group, most_groups> groups;  ///< the first `count` are in use

        /// Of all bright groups together, about: in a medium light per volume, on surfaces per area.
        float fluence(bool in_volume) const;
    };

    /// Knows of none.
    CausticMap() = default;
    /// All caustic lobes of surfaces, or all of media.
    explicit CausticMap(std::vector<CausticLobe> caustics);

    /// The same map with those bright groups alone that are worth drawing from; none where no group is.
    /// `is_worth(cell, group)` is asked of each.
    CausticMap keeping(const std::function<bool(const Cell&, const Group&)>& is_worth) const;

    /// What is known around a position, or null.
    const Cell* find(const Vec3& position) const;

    /// How many caustic lobes there are.
    std::size_t size() const { return size_; }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& map) {
        bytes(map.nodes_, map.cells_, map.size_);
        for (std::size_t i = 0; i < map.nodes_.size(); ++i) {
            const Node& node = map.nodes_[i];
            bytes.require(node.axis < 3 && (node.axis < 0 ? node.next < map.cells_.size()
                                                          : node.next > i && node.next + 1u < map.nodes_.size()));
        }
        for (const Cell& cell : map.cells_) {
            bytes.require(cell.bright <= cell.count && cell.count <= most_groups);
        }
    }

private:
    /// A plane that divides space, or where `axis` is negative a cell.
    struct Node {
        float split = 0;
        std::int32_t axis = -1;
        std::uint32_t next = 0;  ///< the first of two nodes, or the cell
    };

    std::vector<Node> nodes_;
    std::vector<Cell> cells_;
    std::size_t size_ = 0;
};

/// Directions towards the groups of a cell, by how much of their light a scattering function scatters.
class WEND_API CausticLobeMixture {
public:
    /// None.
    CausticLobeMixture() = default;

    /// The bright groups of a cell, as seen from a position, for a ScatteringFunction. Refers to none of them.
    template <class F>
    CausticLobeMixture(const CausticMap::Cell& cell, const Vec3& position, const F& f) : count_(cell.bright) {
        for (std::size_t i = 0; i < count_; ++i) {
            const CausticMap::Group& group = cell.groups[i];
            lobes_[i] = {group.direction(position), group.lobe.kappa};
            weights_[i] = mean_value(group.light) * mean_value(f.evaluate(lobes_[i].mean));
            sum_ += weights_[i];
        }
    }

    /// Whether there is nothing to draw from.
    bool is_empty() const { return !(sum_ > 0); }

    /// A direction, from a number of [0,1) and a point of [0,1)².
    Vec3 sample(float u, const Vec2& u2) const;

    /// Per steradian.
    float density(const Vec3& direction) const;

private:
    std::size_t count_ = 0;
    float sum_ = 0;
    std::array<Vmf, CausticMap::most_groups> lobes_;
    std::array<float, CausticMap::most_groups> weights_{};
};

}  // namespace wend
