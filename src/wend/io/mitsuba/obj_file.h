// Wavefront's files of meshes, `.obj`.
#pragma once

#include <wend/io/ply.h>

#include <filesystem>

namespace wend::mitsuba {

/// Reads positions, texture coordinates, normals and faces, of which polygons become fans; what else a file says is
/// skipped. Corners that have all three alike are one vertex. Normals are there where the file has any (0 for corners
/// without), and so are texture coordinates. Throws InputError with file and line where a number is none, or an index
/// out of range.
TriangleMeshData read_obj(const std::filesystem::path& file);

}  // namespace wend::mitsuba
