// What tests of the interface for C share.
#pragma once

#include <wend/capi/guide.h>
#include <wend/core/vector.h>

#include <gtest/gtest.h>

#include <cstring>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

namespace wend::capi {

constexpr float nan = std::numeric_limits<float>::quiet_NaN();
constexpr float inf = std::numeric_limits<float>::infinity();
constexpr wend_bounds unit_cube = {{0, 0, 0}, {1, 1, 1}};
constexpr wend_vec3 inside = {0.5f, 0.5f, 0.5f};
constexpr wend_vec3 up = {0, 0, 1};

/// Ends what a handle stands for.
template <auto destroy>
struct Destroy {
    template <class Handle>
    void operator()(Handle* handle) const {
        destroy(handle);
    }
};
using FieldPointer = std::unique_ptr<wend_field, Destroy<wend_field_destroy>>;
using LightsPointer = std::unique_ptr<wend_lights, Destroy<wend_lights_destroy>>;
using GuidePointer = std::unique_ptr<wend_interior_guide, Destroy<wend_interior_guide_destroy>>;

inline FieldPointer empty_field() {
    wend_field* field = nullptr;
    EXPECT_EQ(wend_field_create(unit_cube, &field, nullptr), WEND_OK);
    return FieldPointer(field);
}

inline FieldPointer trained_field() {
    const std::vector<wend_record> records(100, {inside, up, 1, 0.5f, inf, 0, 0, 0, {1, 1, 1}});
    wend_field* field = nullptr;
    EXPECT_EQ(wend_field_fit(empty_field().get(), records.data(), records.size(), nullptr, 1, &field, nullptr, nullptr),
              WEND_OK);
    return FieldPointer(field);
}

inline std::vector<char> bytes_of(const wend_field* field) {
    std::size_t size = 0;
    EXPECT_EQ(wend_field_save(field, nullptr, 0, &size, nullptr), WEND_OK);
    std::vector<char> bytes(size);
    EXPECT_EQ(wend_field_save(field, bytes.data(), size, &size, nullptr), WEND_OK);
    return bytes;
}

/// The call is refused with the status and a message that has the words; without a place for the message as well.
inline void expect_refused(wend_status expected, const char* words, const std::function<wend_status(wend_error*)>& call,
                           const char* file, int line) {
    const testing::ScopedTrace trace(file, line, "");
    wend_error error;
    std::memset(&error, 'x', sizeof error);
    EXPECT_EQ(call(&error), expected);
    ASSERT_NE(std::memchr(error.message, 0, sizeof error.message), nullptr);
    EXPECT_NE(std::string(error.message).find(words), std::string::npos) << error.message;
    EXPECT_EQ(call(nullptr), expected);
}
#define EXPECT_REFUSED(expected, words, call_with) \
    expect_refused(                                \
        expected, words, [&](wend_error* e) { return call_with; }, __FILE__, __LINE__)

}  // namespace wend::capi
