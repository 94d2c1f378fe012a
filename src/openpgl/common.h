// Vectors and boxes, and what the other headers need of the compiler.
#pragma once

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
#include <cmath>
#endif

// The library hides all names but those of its interface.
#if defined(_WIN32)
#define OPENPGL_CORE_INTERFACE
#else
#define OPENPGL_CORE_INTERFACE __attribute__((visibility("default")))
#endif

#define OPENPGL_INLINE inline

// C has neither references nor default values. A reference is a pointer to whoever calls from C.
#ifdef __cplusplus
#define OPENPGL_REF(type) type&
#define OPENPGL_DEFAULT(...) \
    { __VA_ARGS__ }
#define OPENPGL_OPTIONAL(value) = value
#define OPENPGL_NOEXCEPT noexcept
#else
#define OPENPGL_REF(type) type*
#define OPENPGL_DEFAULT(...)
#define OPENPGL_OPTIONAL(value)
#define OPENPGL_NOEXCEPT
#endif

/// A direction, a colour, or a difference of points.
typedef struct pgl_vec3f {
    float x, y, z;
#ifdef __cplusplus
    void operator+=(float f) {
        x += f, y += f, z += f;
    }
    void operator-=(float f) {
        x -= f, y -= f, z -= f;
    }
    void operator*=(float f) {
        x *= f, y *= f, z *= f;
    }
    void operator/=(float f) {
        x /= f, y /= f, z /= f;
    }
#endif
} pgl_vec3f;
/// In scene units.
typedef pgl_vec3f pgl_point3f;
/// Of unit length.
typedef pgl_vec3f pgl_direction;
/// Red, green, blue.
typedef pgl_vec3f pgl_spectrum;

typedef struct pgl_vec3i {
    int32_t x, y, z;
} pgl_vec3i;
typedef pgl_vec3i pgl_point3i;

typedef struct pgl_vec2f {
    float x, y;
} pgl_vec2f;
/// Of the plane, or two random numbers.
typedef pgl_vec2f pgl_point2f;

typedef struct pgl_vec2i {
    int32_t x, y;
} pgl_vec2i;
/// A pixel.
typedef pgl_vec2i pgl_point2i;

/// Along the axes; empty where a lower coordinate is above the upper one.
typedef struct pgl_box3f {
    pgl_vec3f lower, upper;
} pgl_box3f;

#ifdef __cplusplus

// By component.
#define OPENPGL_OPERATOR(op)                                               \
    inline pgl_vec3f operator op(const pgl_vec3f& a, const pgl_vec3f& b) { \
        return {a.x op b.x, a.y op b.y, a.z op b.z};                       \
    }                                                                      \
    inline pgl_vec3f operator op(const pgl_vec3f& v, float f) {            \
        return {v.x op f, v.y op f, v.z op f};                             \
    }                                                                      \
    inline pgl_vec3f operator op(float f, const pgl_vec3f& v) {            \
        return {f op v.x, f op v.y, f op v.z};                             \
    }
OPENPGL_OPERATOR(+)
OPENPGL_OPERATOR(-)
OPENPGL_OPERATOR(*)
OPENPGL_OPERATOR(/)
#undef OPENPGL_OPERATOR

inline void pglVec3f(pgl_vec3f& v, float x, float y, float z) {
    v.x = x;
    v.y = y;
    v.z = z;
}
inline void pglVec3fAdd(pgl_vec3f& v, const pgl_vec3f& w) {
    v.x += w.x;
    v.y += w.y;
    v.z += w.z;
}
inline void pglVec2f(pgl_vec2f& v, float x, float y) {
    v.x = x;
    v.y = y;
}
inline void pglVec2fAdd(pgl_vec2f& v, const pgl_vec2f& w) {
    v.x += w.x;
    v.y += w.y;
}
inline void pglPoint3f(pgl_point3f& p, float x, float y, float z) {
    pglVec3f(p, x, y, z);
}
inline void pglPoint2f(pgl_point2f& p, float x, float y) {
    pglVec2f(p, x, y);
}
inline void pglBox3f(pgl_box3f& box, float lower_x, float lower_y, float lower_z, float upper_x, float upper_y,
                     float upper_z) {
    pglVec3f(box.lower, lower_x, lower_y, lower_z);
    pglVec3f(box.upper, upper_x, upper_y, upper_z);
}
inline pgl_vec3f pglNormalize(pgl_vec3f v) {
    return v / std::sqrt(v.x * v.x + v.y * v.y + v.z * v.z);
}

#endif
