// Between C and C++: checks of what comes in, and exceptions that must not go out.
#pragma once

#include <wend/capi/field.h>
#include <wend/core/colour.h>
#include <wend/core/vector.h>

#include <concepts>
#include <string>

namespace wend::capi {

/// Ends a call with a status other than WEND_OK.
struct Refusal {
    wend_status status;
    std::string message;
};

/// Writes the message where it is wanted, cut to what fits, and returns the status.
wend_status answer(wend_error* error, wend_status status, const char* message) noexcept;

/// The status of the exception at hand, with its message.
wend_status answer_exception(wend_error* error) noexcept;

/// Runs the body of a function of the interface, which returns a status or throws.
template <std::invocable Body>
wend_status guarded(wend_error* error, const Body& body) noexcept {
    try {
        const wend_status status = body();
        return status == WEND_OK ? answer(error, status, "") : status;
    } catch (...) {
        return answer_exception(error);
    }
}

/// Throws a Refusal, a bad argument, unless the rule holds.
inline void require(bool holds, const char* rule) {
    if (!holds) [[unlikely]] {
        throw Refusal{WEND_BAD_ARGUMENT, rule};
    }
}

/// Throws a Refusal where a segment cannot have the length.
inline void require_length(float length) {
    require(length >= 0 && length <= longest_segment, "a length must be 0 to 1e30");
}

/// What WEND_NOTHING_LEARNED says.
inline constexpr const char* nothing_learned = "the field has learned nothing yet";

/// A finite vector within the coordinates that a field can hold.
Vec3 to_position(const wend_vec3& v, const char* name);
/// A vector of unit length.
Vec3 to_direction(const wend_vec3& v, const char* name);
inline wend_vec3 from_vector(const Vec3& v) {
    return {v.x, v.y, v.z};
}
/// As it is: nothing is checked.
inline Vec3 to_vector(const wend_vec3& v) {
    return {v.x, v.y, v.z};
}
/// A box that is not empty.
Box3 to_box(const wend_bounds& bounds);

/// As it is: nothing is checked.
inline Rgb to_rgb(const float (&c)[3]) {
    return {c[0], c[1], c[2]};
}
/// Finite channels, not negative.
Rgb to_weight(const float (&c)[3], const char* name);
void put(const Rgb& colour, float* channels);

/// A finite number that is not negative.
void require_weight(float number, const char* name);
/// A number of [0,1).
void require_uniform(double u);
/// A number of threads, 0 for all.
void require_threads(int threads);

}  // namespace wend::capi
