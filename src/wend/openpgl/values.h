// Between Open PGL's plain values and Wend's.
#pragma once

#include <openpgl/data.h>
#include <wend/core/colour.h>
#include <wend/core/vector.h>

namespace wend::openpgl {

inline Vec3 to_vector(const pgl_vec3f& v) {
    return {v.x, v.y, v.z};
}
inline pgl_vec3f from_vector(const Vec3& v) {
    return {v.x, v.y, v.z};
}
inline Rgb to_colour(const pgl_vec3f& v) {
    return {v.x, v.y, v.z};
}
inline pgl_vec3f from_colour(const Rgb& c) {
    return {c.r, c.g, c.b};
}

}  // namespace wend::openpgl
