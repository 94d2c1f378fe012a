#pragma once

#include <wend/core/vector.h>

#include <limits>

namespace wend {

/// The distance to what is not there.
inline constexpr float infinity = std::numeric_limits<float>::infinity();

/// How long a ray's segment is where nothing is near: further than any scene reaches, and finite, so that it can be
/// multiplied.
inline constexpr float longest_segment = 1e30f;

/// A half-line.
struct Ray {
    Vec3 origin;     ///< where it begins, in scene units
    Vec3 direction;  ///< of unit length, so that distances along the ray are in scene units
    float time = 0;  ///< from 0, where what moves is at its start, to 1, where it is at its end

    /// The point at a distance along the ray.
    Vec3 at(float t) const { return origin + direction * t; }
};

}  // namespace wend
