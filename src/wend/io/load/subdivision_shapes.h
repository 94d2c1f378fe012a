// Subdivision surfaces of scene files, as meshes of triangles.
#pragma once

#include <wend/io/load/context.h>
#include <wend/scene/shape.h>

namespace wend {

/// pbrt's "loopsubdiv". Throws InputError for what is no mesh of triangles, and where too many would come of it.
Shape load_loop_surface(LoadContext& context, pbrt::ShapeEntity& shape);

/// The shape "subdivision", which pbrt has not: its parameters are those of USD's meshes (docs/pbrt.md). Throws
/// InputError for indices out of range, counts that do not go together, unknown names of rules, faces that the scheme
/// does not take, and where too many triangles would come of it.
Shape load_subdivision_surface(LoadContext& context, pbrt::ShapeEntity& shape);

}  // namespace wend
