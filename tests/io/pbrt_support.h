// What the tests of the pbrt parser share.
#pragma once

#include "tests/io/errors.h"

#include <wend/io/pbrt/parser.h>

#include <string>
#include <vector>

namespace wend::pbrt {

using test::message_of;

/// For EXPECT_PRED2, which prints both where it fails.
inline bool contains(const std::string& text, const std::string& part) {
    return text.find(part) != std::string::npos;
}

/// What parsing and its errors name "t.pbrt".
inline Description parse(const std::string& text) {
    return parse_string(text, {}, "t.pbrt");
}

/// What follows WorldBegin, from line 2 on.
inline Description parse_world(const std::string& text) {
    return parse("WorldBegin\n" + text);
}

template <typename Value, typename... Arguments>
std::vector<Value> list(Arguments... values) {
    return {static_cast<Value>(values)...};
}

}  // namespace wend::pbrt
