// Between C and C++: checks of what comes in, and exceptions that must not go out.
#pragma once

#include <wend/capi/guide.h>
#include <wend/core/vector.h>

#include <concepts>
#include <cstdint>
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

/// A finite vector within the coordinates that a field can hold.
Vec3 to_position(const wend_vec3& v, const char* name);
/// A vector of unit length.
Vec3 to_direction(const wend_vec3& v, const char* name);
inline wend_vec3 from_vector(const Vec3& v) {
    return {v.x, v.y, v.z};
}

/// A C++ value inside an opaque object of C. The mark tells it from memory that nobody has filled.
template <class Value, std::uint64_t own_mark>
struct Stored {
    static constexpr std::uint64_t mark = own_mark;

    std::uint64_t found = mark;
    Value value;
};

}  // namespace wend::capi
