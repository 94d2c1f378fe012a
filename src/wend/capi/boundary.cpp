#include <wend/capi/boundary.h>

#include <wend/core/error.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <exception>
#include <new>

namespace wend::capi {

wend_status answer(wend_error* error, wend_status status, const char* message) noexcept {
    if (error) {
        const std::size_t length = std::min(std::strlen(message), sizeof error->message - 1);
        std::memcpy(error->message, message, length);
        error->message[length] = '\0';
    }
    return status;
}

wend_status answer_exception(wend_error* error) noexcept {
    try {
        throw;
    } catch (const Refusal& refusal) {
        return answer(error, refusal.status, refusal.message.c_str());
    } catch (const InputError& e) {
        return answer(error, WEND_BAD_ARGUMENT, e.what());
    } catch (const std::bad_alloc&) {
        return answer(error, WEND_OUT_OF_MEMORY, "out of memory");
    } catch (const std::exception& e) {
        return answer(error, WEND_INTERNAL_ERROR, e.what());
    } catch (...) {
        return answer(error, WEND_INTERNAL_ERROR, "an unknown exception");
    }
}

Vec3 to_position(const wend_vec3& v, const char* name) {
    // Beyond, squares and sums overflow.
    constexpr float largest = 1e15f;
    if (!(std::abs(v.x) <= largest && std::abs(v.y) <= largest && std::abs(v.z) <= largest)) {
        throw Refusal{WEND_BAD_ARGUMENT, std::string(name) + " must have finite coordinates, up to 1e15"};
    }
    return {v.x, v.y, v.z};
}

Vec3 to_direction(const wend_vec3& v, const char* name) {
    constexpr float tolerance = 2e-3f;  // of the square
    const Vec3 direction(v.x, v.y, v.z);
    if (!(std::abs(length_squared(direction) - 1) <= tolerance)) {
        throw Refusal{WEND_BAD_ARGUMENT, std::string(name) + " must have unit length"};
    }
    return direction;
}

}  // namespace wend::capi
