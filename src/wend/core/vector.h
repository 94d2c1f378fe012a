// Points, directions and boxes: Imath's types under the project's names, and the few operations Imath spells
// differently.
#pragma once

#include <Imath/ImathBox.h>
#include <Imath/ImathVec.h>

#include <cmath>
#include <limits>

namespace wend {

/// A point of the plane, or two random numbers.
using Vec2 = Imath::V2f;
/// A point, or a direction.
using Vec3 = Imath::V3f;
/// A pixel, or another pair of integers.
using Vec2i = Imath::V2i;
/// A voxel, or another triple of integers.
using Vec3i = Imath::V3i;
/// A box along the axes; empty at first.
using Box3 = Imath::Box3f;

/// π.
inline constexpr float pi = 3.14159265358979323846f;
/// 1 / π: the value of a white diffuse reflector, in 1/sr.
inline constexpr float inv_pi = 0.31830988618379067154f;
/// 1 / (4 π): the uniform density over directions, in 1/sr.
inline constexpr float inv_4pi = 0.07957747154594766788f;

/// Largest float below 1: where a uniform number in [0,1) is clamped to.
inline constexpr float one_minus_epsilon = 0x1.fffffep-1f;

/// Inner product.
inline float dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// The inner product without its sign: of unit vectors the cosine between lines.
inline float abs_dot(const Vec3& a, const Vec3& b) {
    return std::abs(dot(a, b));
}
/// Right-handed vector product.
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
/// dot(v, v), without a root.
inline float length_squared(const Vec3& v) {
    return dot(v, v);
}
/// Euclidean norm.
inline float length(const Vec3& v) {
    return std::sqrt(dot(v, v));
}
/// v scaled to unit length; v must not be zero.
inline Vec3 normalize(const Vec3& v) {
    return v * (1.0f / length(v));
}
/// Whether no coordinate is infinite or NaN.
inline bool is_finite(const Vec3& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
/// x².
inline float sqr(float x) {
    return x * x;
}
/// sqrt of the positive part: rounding may leave a tiny negative number where mathematics has zero.
inline float safe_sqrt(float x) {
    return x > 0 ? std::sqrt(x) : 0.0f;
}

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
