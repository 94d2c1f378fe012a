#include <wend/io/image_file.h>
#include <wend/io/image_size.h>

#include <fmt/format.h>

namespace wend {

void check_image_size(std::int64_t width, std::int64_t height, std::uintmax_t file_bytes, const Place& place) {
    // Deflate, the strongest of the usual codecs on an empty picture, packs 8 kpixels of one bit into a byte.
    constexpr std::uintmax_t most_pixels_a_byte = 1 << 14;
    if (width <= 0 || height <= 0) {
        throw InputError(place, fmt::format("a picture cannot have {} x {} pixels", width, height));
    }
    if (width > max_pixels || height > max_pixels || width * height > max_pixels) {
        throw InputError(place, fmt::format("the picture is too large: {} x {} pixels", width, height));
    }
    if (static_cast<std::uintmax_t>(width * height) / most_pixels_a_byte > file_bytes) {
        throw InputError(place, fmt::format("the picture is truncated: {} bytes cannot hold {} x {} pixels", file_bytes,
                                            width, height));
    }
}

}  // namespace wend
