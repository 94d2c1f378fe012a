#include <wend/io/jpeg_check.h>

#include <algorithm>
#include <cstddef>
#include <numeric>

namespace wend {
namespace {

constexpr unsigned char start_of_image = 0xd8, end_of_image = 0xd9, define_huffman = 0xc4;

bool has_length(unsigned char marker) {
    const bool restart = marker >= 0xd0 && marker <= 0xd7;
    return marker > 0x01 && !restart && marker != start_of_image && marker != end_of_image;
}

/// The tables of a segment of `length` bytes: a byte for the kind, 16 counts of codes by length, and as many symbols as
/// they add up to. The last may reach beyond the segment, as stb reads it, and beyond the file, where our source has
/// line breaks for it.
bool tables_fit(std::basic_string_view<unsigned char> bytes, std::size_t length) {
    constexpr std::size_t lengths = 16;
    for (std::size_t at = 0; at < std::min(length, bytes.size());) {
        const auto counts = bytes.substr(at + 1, lengths);
        const int missing = static_cast<int>(lengths - counts.size());
        const int symbols = std::accumulate(counts.begin(), counts.end(), missing * '\n');
        if (symbols > 256) {
            return false;
        }
        at += 1 + lengths + static_cast<std::size_t>(symbols);
    }
    return true;
}

}  // namespace

bool huffman_tables_fit(std::string_view file) {
    const std::basic_string_view<unsigned char> bytes(reinterpret_cast<const unsigned char*>(file.data()), file.size());
    // Markers are the bytes 0xff, any number of them, and another one; in compressed data 0 follows a plain 0xff.
    const std::size_t first = bytes.find_first_not_of(0xff);
    if (first == 0 || first == bytes.npos || bytes[first] != start_of_image) {
        return true;
    }
    for (std::size_t at = first + 1; at + 1 < bytes.size();) {
        if (bytes[at] != 0xff) {
            ++at;
            continue;
        }
        const unsigned char marker = bytes[at + 1];
        if (marker == 0xff) {
            ++at;
            continue;
        }
        at += 2;
        if (!has_length(marker) || at + 2 > bytes.size()) {
            continue;
        }
        const std::size_t length = std::max<std::size_t>(bytes[at] * 256u + bytes[at + 1], 2);
        if (marker == define_huffman && !tables_fit(bytes.substr(at + 2), length - 2)) {
            return false;
        }
        at += length;
    }
    return true;
}

}  // namespace wend
