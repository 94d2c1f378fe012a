#pragma once

#include <wend/core/vector.h>

#include <limits>

namespace wend {

inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// How long a ray's segment is where nothing is near: further than any scene reaches, and finite, so that it can be
/// multiplied.
inline constexpr float longest_segment = 1e30f;

/// A half-line. `direction` has unit length, so distances along the ray are in scene units.
struct Ray {
    Vec3 origin;
    Vec3 direction;

    Vec3 at(float t) const { return origin + direction * t; }
};

}  // namespace wend
