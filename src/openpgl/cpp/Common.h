// Values and what one asks of them.
#pragma once

#include <openpgl/openpgl.h>

#include <algorithm>
#include <cmath>

namespace openpgl {
namespace cpp {

struct Vector3f : pgl_vec3f {
    Vector3f(const pgl_vec3f& v) : pgl_vec3f(v) {}
    Vector3f(float x_, float y_, float z_) : pgl_vec3f{x_, y_, z_} {}
    Vector3f(float v) : pgl_vec3f{v, v, v} {}
};
struct Vector2f : pgl_vec2f {
    Vector2f(const pgl_vec2f& v) : pgl_vec2f(v) {}
    Vector2f(float x_, float y_) : pgl_vec2f{x_, y_} {}
    Vector2f(float v) : pgl_vec2f{v, v} {}
};
struct Point3f : pgl_point3f {
    Point3f(const pgl_point3f& p) : pgl_point3f(p) {}
    Point3f(float x_, float y_, float z_) : pgl_point3f{x_, y_, z_} {}
    Point3f(float v) : pgl_point3f{v, v, v} {}
};
struct Point2f : pgl_point2f {
    Point2f(const pgl_point2f& p) : pgl_point2f(p) {}
    Point2f(float x_, float y_) : pgl_point2f{x_, y_} {}
    Point2f(float v) : pgl_point2f{v, v} {}
};
struct Point3i : pgl_point3i {
    Point3i(const pgl_point3i& p) : pgl_point3i(p) {}
    Point3i(int32_t x_, int32_t y_, int32_t z_) : pgl_point3i{x_, y_, z_} {}
    Point3i(int32_t v) : pgl_point3i{v, v, v} {}
};
struct Point2i : pgl_point2i {
    Point2i(const pgl_point2i& p) : pgl_point2i(p) {}
    Point2i(int32_t x_, int32_t y_) : pgl_point2i{x_, y_} {}
    Point2i(int32_t v) : pgl_point2i{v, v} {}
};
struct Box3f : pgl_box3f {
    Box3f(const Point3f& lower_, const Point3f& upper_) : pgl_box3f{lower_, upper_} {}
};

inline pgl_vec3f Vector3(float x, float y, float z) {
    return {x, y, z};
}
inline pgl_vec2f Vector2(float x, float y) {
    return {x, y};
}
inline pgl_point3f Point3(float x, float y, float z) {
    return {x, y, z};
}
inline pgl_point2f Point2(float x, float y) {
    return {x, y};
}
inline pgl_box3f Box3(const pgl_point3f& lower, const pgl_point3f& upper) {
    return {lower, upper};
}
inline pgl_box3f Box3(float lower_x, float lower_y, float lower_z, float upper_x, float upper_y, float upper_z) {
    return {{lower_x, lower_y, lower_z}, {upper_x, upper_y, upper_z}};
}

/// Whether all components are finite.
inline bool IsValid(const pgl_vec3f& v) {
    return std::isfinite(v.x) && std::isfinite(v.y) && std::isfinite(v.z);
}
inline bool IsZero(const pgl_vec3f& v) {
    return v.x == 0 && v.y == 0 && v.z == 0;
}
inline float Max(const pgl_vec3f& v) {
    return std::max({v.x, v.y, v.z});
}
inline float Average(const pgl_vec3f& v) {
    return (v.x + v.y + v.z) / 3;
}
inline float Average(const pgl_vec2f& v) {
    return (v.x + v.y) / 2;
}

// Nothing is compressed.
inline pgl_direction CompressDirection(const pgl_vec3f& direction) {
    return direction;
}
inline pgl_vec3f DecompressDirection(const pgl_direction& direction) {
    return direction;
}
inline pgl_spectrum CompressSpectrum(const pgl_vec3f& spectrum) {
    return spectrum;
}
inline pgl_vec3f DecompressSpectrum(const pgl_spectrum& spectrum) {
    return spectrum;
}

}  // namespace cpp
}  // namespace openpgl
