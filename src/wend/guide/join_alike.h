// Cells that scatter nearly the same light, taken for one by rays.
#pragma once

#include <wend/guide/field.h>

namespace wend::guide {

/// The field with each of its subtrees whose cells scatter nearly the same light, and have no lights close by, told to
/// rays as one cell. What they are told is the mean over the cells' volume; a position is told the same, until the next
/// fit.
Field join_alike(Field field);

}  // namespace wend::guide
