#pragma once

#include <wend/core/vector.h>
#include <wend/io/ply.h>

#include <cstdint>
#include <optional>
#include <span>

namespace wend {

/// The surface that Loop's subdivision of a mesh of triangles tends to (loop1987): `levels` times each triangle becomes
/// four, then vertices move to the limit surface and get its normals, which are zero where it has none. Boundaries tend
/// to smooth curves, and edges of more than two triangles stay sharp. `indices` are three a triangle, each below the
/// number of positions. Faces without area by their indices are left out. None if nothing is left.
std::optional<TriangleMeshData> subdivide(std::span<const Vec3> positions, std::span<const std::uint32_t> indices,
                                          int levels);

}  // namespace wend
