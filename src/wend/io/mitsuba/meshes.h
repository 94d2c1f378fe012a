// Meshes of Mitsuba scenes, in the world.
#pragma once

#include <wend/io/mitsuba/directive.h>
#include <wend/io/ply.h>

namespace wend::mitsuba {

/// The mesh that a shape is: `cube`, `disk`, `obj`, `ply`, `rectangle` or `serialized`, with normals as Mitsuba has
/// them: of files without any, means over the triangles at a vertex by their angles, unless faces are to be flat.
TriangleMeshData mesh_of(const Object& shape);

/// As parameters of a `trianglemesh`.
void set_mesh(const TriangleMeshData& mesh, Parameters& p);

}  // namespace wend::mitsuba
