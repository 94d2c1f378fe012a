// What the tests of the pbrt parser share.
#pragma once

#include <wend/core/error.h>

#include <string>
#include <vector>

namespace wend::pbrt {

/// For EXPECT_PRED2, which prints both where it fails.
inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// The message of the InputError that `act` ends in.
template <typename Act>
std::string message_of(Act act) {
    try {
        act();
    } catch (const InputError& error) {
        return error.what();
    }
    return "no error";
}

template <typename Value, typename... Arguments>
std::vector<Value> list(Arguments... values) {
    return {static_cast<Value>(values)...};
}

}  // namespace wend::pbrt
