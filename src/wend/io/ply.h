#pragma once

#include <wend/core/vector.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <limits>
#include <string>
#include <vector>

namespace wend {

/// Numbers that a mesh has beside its shape.
struct MeshAttribute {
    std::string name;  ///< "vertex_..." or "face_..."
    std::size_t channels;
    std::vector<float> values;  ///< of each vertex, or each triangle, so many
};

/// Triangles as a file gives them, checked: coordinates are finite, indices are in range.
struct TriangleMeshData {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;           ///< one a vertex, of any length, or none; they may not be finite
    std::vector<Vec2> uvs;               ///< one a vertex, or none
    std::vector<std::uint32_t> indices;  ///< three a triangle
    std::vector<Vec3> end_positions;     ///< one a vertex, or none: as TriangleMesh has them
    std::vector<Vec3> end_normals;       ///< the same
    std::vector<Vec3> tangents;          ///< the same
    std::vector<MeshAttribute> attributes{};
    std::vector<std::uint32_t> quadrilaterals{};  ///< the first triangles of polygons that are two
    std::size_t first_quadrilateral = std::numeric_limits<std::size_t>::max();  ///< as TriangleMesh has it
};

/// Reads a PLY file: ascii or binary of either byte order, compressed by gzip or not. Polygons become fans of
/// triangles; what is neither a position, normal (nx, ny, nz), uv (u, v or s, t, with or without the prefix `texture_`)
/// nor a face's vertices is skipped. Throws InputError with the place (the line, in the header and in ascii files) when
/// the file is missing, malformed or truncated, an index is out of range, or a position is not finite; texture
/// coordinates that are not become 0. Numbers beside the shape are skipped as well unless they are asked for.
TriangleMeshData read_ply(const std::filesystem::path& file, bool with_attributes = false);

}  // namespace wend
