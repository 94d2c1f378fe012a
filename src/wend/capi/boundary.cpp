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

Box3 to_box(const wend_bounds& bounds) {
    const Box3 box(to_position(bounds.min, "bounds.min"), to_position(bounds.max, "bounds.max"));
    require(!box.isEmpty(), "bounds.min must not be above bounds.max");
    return box;
}

Rgb to_weight(const float (&c)[3], const char* name) {
    for (const float channel : c) {
        require_weight(channel, name);
    }
    return to_rgb(c);
}

void put(const Rgb& colour, float* channels) {
    for (int c = 0; c < 3; ++c) {
        channels[c] = colour[c];
    }
}

void require_weight(float number, const char* name) {
    if (!(number >= 0 && std::isfinite(number))) {
        throw Refusal{WEND_BAD_ARGUMENT, std::string(name) + " must be finite and not negative"};
    }
}

void require_uniform(double u) {
    require(u >= 0 && u < 1, "uniform numbers must be in [0,1)");
}

void require_threads(int threads) {
    require(threads >= 0 && threads <= 1024, "the threads must be 0 to 1024");
}

}  // namespace wend::capi
