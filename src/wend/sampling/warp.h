// Elementary maps from uniform numbers to points and directions. Each density is with respect to area or solid angle.
#pragma once

#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/numeric/fast_math.h>

#include <algorithm>
#include <cmath>

namespace wend {

/// Uniform on the unit disk, by the concentric map (shirley1997).
inline Vec2 to_disk(const Vec2& u) {
    const float x = 2 * u.x - 1;
    const float y = 2 * u.y - 1;
    if (x == 0 && y == 0) {
        return {0, 0};
    }
    const bool wide = std::abs(x) > std::abs(y);
    const float r = wide ? x : y;
    const float phi = wide ? (pi / 4) * (y / x) : (pi / 2) - (pi / 4) * (x / y);
    return {r * std::cos(phi), r * std::sin(phi)};
}

/// A direction with density cos/pi on the hemisphere around +z.
inline Vec3 to_cosine_hemisphere(const Vec2& u) {
    const Vec2 d = to_disk(u);
    return {d.x, d.y, safe_sqrt(1 - d.x * d.x - d.y * d.y)};
}
/// The density of to_cosine_hemisphere(), in 1/sr; 0 below the horizon.
inline float cosine_hemisphere_density(float cosine) {
    return std::max(0.0f, cosine) * inv_pi;
}

/// The unit vector with the given cosine to +z and azimuth 2*pi*u.
inline Vec3 direction_from_cosine(float cosine, float u) {
    const float sine = safe_sqrt(1 - cosine * cosine);
    const float phi = 2 * pi * u;
    return {sine * std::cos(phi), sine * std::sin(phi), cosine};
}

/// Uniform on the sphere: density 1/(4 pi).
inline Vec3 to_sphere(const Vec2& u) {
    return direction_from_cosine(1 - 2 * u.x, u.y);
}

/// Uniform in the cone around +z of which `one_minus_cosine` = 1 - cos(half angle), given thus because it may be tiny.
inline Vec3 to_cone(const Vec2& u, float one_minus_cosine) {
    const float x = u.x * one_minus_cosine;  // 1 - cos
    const float sine = safe_sqrt(x * (2 - x));
    const float phi = 2 * pi * u.y;
    return {sine * std::cos(phi), sine * std::sin(phi), 1 - x};
}
/// The density of to_cone() within the cone, in 1/sr.
inline float cone_density(float one_minus_cosine) {
    return 1 / (2 * pi * one_minus_cosine);
}

/// Barycentric coordinates (of the second and third vertex) of a uniform point in a triangle, with less distortion than
/// the square root map (heitz2019).
inline Vec2 to_triangle(const Vec2& u) {
    return u.y > u.x ? Vec2(u.x * 0.5f, u.y - u.x * 0.5f) : Vec2(u.x - u.y * 0.5f, u.y * 0.5f);
}

/// A distance with density rate * exp(-rate * t); u in [0,1). Uniform numbers are multiples of 2^-24, so 1 - u is
/// exact.
inline float to_exponential(float u, float rate) {
    return -fast_log(1 - u) / rate;
}

/// An optical depth with density exp(-x), however rare: what lies beyond the first ln 256 is like the whole again, and
/// within it a uniform float is fine enough.
inline float sample_optical_depth(Pcg32& random) {
    constexpr float beyond = 1.0f / 256, ln_256 = 5.545177444f;
    float passed = 0;
    float left = 1 - random.uniform();
    while (left <= beyond) {
        passed += ln_256;
        left = 1 - random.uniform();
    }
    return passed - fast_log(left);
}

/// Point i of n in a lattice of the unit square by the golden ratio, moved by a shift in [0,1)² around its edges. With
/// a uniformly random shift each point is uniform.
inline Vec2 golden_lattice_point(int i, int n, const Vec2& shift) {
    constexpr double golden = 0.6180339887498949;
    const double x = (i + 0.5) / n + static_cast<double>(shift.x);
    const double y = i * golden + static_cast<double>(shift.y);
    return {std::min(static_cast<float>(x - std::floor(x)), 0x1.fffffep-1f),
            std::min(static_cast<float>(y - std::floor(y)), 0x1.fffffep-1f)};
}

}  // namespace wend
