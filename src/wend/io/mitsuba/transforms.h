// Vectors and transforms of Mitsuba scenes.
#pragma once

#include <wend/core/transform.h>
#include <wend/io/mitsuba/element.h>

#include <ImathVec.h>

namespace wend::mitsuba {

/// By `x`, `y` and `z`, of which those that are absent are `missing`, or by `value`: three numbers, or one for all.
/// Throws InputError for other values.
Imath::V3d vector_of(const Element& element, double missing);

/// `<transform>`: its steps, each after those before it. Throws InputError where a step is none, or has no inverse.
Transform transform_of(const Element& element);

}  // namespace wend::mitsuba
