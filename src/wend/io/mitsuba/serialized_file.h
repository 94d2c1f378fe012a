// Mitsuba's own files of meshes, `.serialized`.
#pragma once

#include <wend/io/ply.h>

#include <filesystem>

namespace wend::mitsuba {

/// A mesh of a file, with what the file says about its normals.
struct SerializedMesh {
    TriangleMeshData mesh;
    bool has_face_normals = false;
};

/// Reads one of the meshes of a file of version 3 or 4, counted from 0. Throws InputError naming the file if it is
/// missing, broken or truncated, has no such mesh, or an index is out of range. Takes no more memory than what is
/// unpacked, which is 4 GiB at most.
SerializedMesh read_serialized(const std::filesystem::path& file, int index);

}  // namespace wend::mitsuba
