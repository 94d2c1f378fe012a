#pragma once

#include <wend/core/vector.h>

namespace wend {

/// A right-handed orthonormal basis.
struct Frame {
    Vec3 s{1, 0, 0};  ///< local x, unit length
    Vec3 t{0, 1, 0};  ///< local y, unit length
    Vec3 n{0, 0, 1};  ///< local z, unit length: a normal, or a direction of propagation

    /// A basis around a unit vector, without branches or singularities (duff2017, listing 3).
    static Frame from_z(const Vec3& n) {
        const float sign = std::copysign(1.0f, n.z);
        const float a = -1.0f / (sign + n.z);
        const float b = n.x * n.y * a;
        return {Vec3(1 + sign * n.x * n.x * a, sign * b, -sign * n.x), Vec3(b, sign + n.y * n.y * a, -n.y), n};
    }

    /// Coordinates of a vector in the basis.
    Vec3 to_local(const Vec3& v) const { return {dot(v, s), dot(v, t), dot(v, n)}; }
    /// The vector that has these coordinates in the basis.
    Vec3 to_world(const Vec3& v) const { return s * v.x + t * v.y + n * v.z; }
};

}  // namespace wend
