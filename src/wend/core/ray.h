#pragma once

#include <wend/core/vector.h>

#include <limits>

namespace wend {

inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// A half-line. `direction` has unit length, so distances along the ray are in scene units.
struct Ray {
    Vec3 origin;
    Vec3 direction;

    Vec3 at(float t) const { return origin + direction * t; }
};

}  // namespace wend
