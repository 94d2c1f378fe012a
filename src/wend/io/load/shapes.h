#pragma once

#include <wend/io/load/context.h>
#include <wend/scene/shape.h>

#include <optional>

namespace wend {

/// The shape of a directive, in the world (for shapes of an object: in the object's space); none, with a warning, for a
/// mesh without triangles. `as_mesh`: of a kind that may shine or bound a medium. Throws InputError for unknown types,
/// missing or broken files, vertices that are not finite and indices out of range.
std::optional<Shape> load_shape(LoadContext& context, pbrt::ShapeEntity& shape, bool as_mesh);

/// Whether the geometric normal is the reverse of what the shape gives it: pbrt keeps normals on the side where
/// mirroring takes them, ReverseOrientation aside.
bool flips_normal(const pbrt::ShapeEntity& shape);

}  // namespace wend
