// Edges at which triangles do not meet as those of a closed, consistently oriented surface do.
#pragma once

#include <wend/scene/shape.h>

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace wend {

/// A mesh with the side that is out.
struct OrientedMesh {
    const TriangleMesh* mesh = nullptr;
    bool reversed = false;  ///< out is against the winding, or against the normals where there are any

    /// The corners of a triangle, counterclockwise seen from outside.
    std::array<Vec3, 3> triangle(std::size_t i) const;
};

/// An edge along which triangles run more often one way than the other: `from` to `to`, `surplus` times more often.
struct LooseEdge {
    Vec3 from, to;
    std::array<std::uint32_t, 2> ends{};  ///< the same number for points in the same place
    int surplus = 0;                      ///< positive
    int uses = 0;                         ///< triangles at the edge
    std::uint32_t mesh = 0;               ///< one of those that have it
};

/// The loose edges of several meshes taken together. Points are the same if they are nearer than 1e-5 of the size of
/// all. A closed, consistently oriented surface has none, and takes linear time and little memory; nothing is returned
/// for a soup of triangles with more than a million.
std::optional<std::vector<LooseEdge>> loose_edges(std::span<const OrientedMesh> meshes);

}  // namespace wend
