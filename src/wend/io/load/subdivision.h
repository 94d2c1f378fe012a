#pragma once

#include <wend/core/vector.h>
#include <wend/io/ply.h>

#include <cstdint>
#include <optional>
#include <vector>

namespace wend {

/// What refines a mesh, and what it tends to at boundaries and across seams of texture coordinates: the rules of
/// OpenSubdiv, which are those of USD's meshes.
struct SubdivisionRules {
    enum class Scheme { catmull_clark, loop, bilinear };
    enum class Boundary { none, edge_only, edge_and_corner };
    enum class FaceVarying { none, corners_only, corners_plus1, corners_plus2, boundaries, all };
    enum class Triangles { catmull_clark, smooth };

    Scheme scheme = Scheme::catmull_clark;
    /// Whether faces at the boundary are left out, or their edges are sharp, or also vertices of a single face.
    Boundary boundary = Boundary::edge_and_corner;
    /// Where texture coordinates are linear.
    FaceVarying face_varying = FaceVarying::corners_plus1;
    /// Of triangles under Catmull and Clark's scheme.
    Triangles triangles = Triangles::catmull_clark;
};

/// The mesh that a subdivision surface is made of.
struct ControlMesh {
    /// Sharper than this no edge or vertex is: it stays where it is.
    static constexpr float infinitely_sharp = 10;

    struct Crease {
        std::uint32_t from, to;  ///< two vertices of an edge
        float sharpness;         ///< levels for which it is sharp
    };
    struct Corner {
        std::uint32_t vertex;
        float sharpness;
    };

    std::vector<Vec3> positions;
    std::vector<Vec3> end_positions;        ///< at time 1 (TriangleMesh); empty where nothing moves
    std::vector<std::uint32_t> face_sizes;  ///< corners of each face, three or more
    std::vector<std::uint32_t> corners;     ///< vertices of all faces, against the clock
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> uv_corners;  ///< which of `uvs` each corner has; none without `uvs`
    std::vector<Crease> creases;
    std::vector<Corner> sharp_corners;
    std::vector<std::uint32_t> holes;  ///< faces that are not there, and shape their neighbours nevertheless
};

/// The surface that subdivision of a mesh tends to (catmull1978, loop1987), cut into triangles: each edge of the
/// control mesh becomes 2^levels edges, whose ends are on the surface and have its normals. These are zero where it has
/// none, and differ from face to face at creases that stay sharp. Texture coordinates are one a vertex if there are
/// any. What moves is on the limit of what the control mesh is at both ends.
///
/// Indices must be within their ranges. Faces with a vertex twice are left out, and creases along what is no edge are
/// ignored. None if nothing is left. Throws std::invalid_argument for faces of other than 3 to 256 corners, of other
/// than 3 for Loop's scheme, and vertices of more than 256 edges.
std::optional<TriangleMeshData> limit_surface(const ControlMesh& control, const SubdivisionRules& rules, int levels);

/// How many triangles limit_surface() makes at most.
double limit_triangles(const ControlMesh& control, int levels);

}  // namespace wend
