// Lights that shine from a point into a cone, as flights through their beam know them.
#pragma once

#include <wend/core/export.h>
#include <wend/core/ray.h>

#include <optional>

namespace wend {

/// What a spot light lights, but for what stands in its way.
struct Beam {
    Vec3 position;        ///< of the lamp, in scene units
    Vec3 axis;            ///< unit length, the way that it shines
    float cosine = 1;     ///< of half the cone's angle, above 0
    float intensity = 0;  ///< power per steradian, mean of the channels, along the axis
};

/// A part of a ray.
struct RayInterval {
    float t_in;   ///< distance of its beginning
    float t_out;  ///< distance of its end
};

/// Where the first `length` of a ray with a unit direction is in the cone; none where it is not. The cone is convex.
WEND_API std::optional<RayInterval> crossing(const Beam& beam, const Ray& ray, float length);

}  // namespace wend
