// The header of a PLY file: what its body holds, and how.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wend::ply {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

std::size_t bytes_of(Type type);

struct Property {
    std::string name;
    Type type;                       ///< of the value, or of each value of a list
    std::optional<Type> count_type;  ///< lists only
};

struct Element {
    std::string name;
    std::uint64_t count;
    std::vector<Property> properties;
};

enum class Format { ascii, little_endian, big_endian };

struct Header {
    Format format = Format::ascii;
    std::vector<Element> elements;
    std::size_t bytes = 0;  ///< where the body begins
    int lines = 0;          ///< above the body

    const Element* find(std::string_view name) const {
        const auto found =
            std::find_if(elements.begin(), elements.end(), [&](const Element& e) { return e.name == name; });
        return found == elements.end() ? nullptr : &*found;
    }
};

inline bool is_space(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\n';
}

/// Throws InputError, with `file` and the line, if the bytes do not begin with a header.
Header parse_header(std::string_view bytes, const std::string& file);

}  // namespace wend::ply
