#pragma once

#include <wend/io/load/context.h>
#include <wend/scene/shape.h>

namespace wend {

/// The curves of a "curve" directive, in the world. Widths are scaled as much as volumes are on average. Throws
/// InputError for control points or normals of the wrong number, widths below 0, and unknown kinds.
Shape load_curve(LoadContext& context, pbrt::ShapeEntity& shape);

/// Whether two sets may be one: `more` is appended to `curves` then.
bool merge(CurveSet& curves, const CurveSet& more);

}  // namespace wend
