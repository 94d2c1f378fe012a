#include <wend/io/image_size.h>

#include <wend/io/image_file.h>

#include <fmt/format.h>

namespace wend {

bool is_credible_size(std::int64_t pixels, std::uintmax_t file_bytes) {
    // A picture of 8192 x 4096 pixels may be of one colour; larger ones have something in them.
    constexpr std::uintmax_t base = 1 << 25, most_pixels_a_byte = 64;
    return static_cast<std::uintmax_t>(pixels) <= base + most_pixels_a_byte * file_bytes;
}

void check_image_size(std::int64_t width, std::int64_t height, std::uintmax_t file_bytes, const Place& place) {
    if (width <= 0 || height <= 0) {
        throw InputError(place, fmt::format("a picture cannot have {} x {} pixels", width, height));
    }
    if (width > max_pixels || height > max_pixels || width * height > max_pixels) {
        throw InputError(place, fmt::format("the picture is too large: {} x {} pixels", width, height));
    }
    if (!is_credible_size(width * height, file_bytes)) {
        throw InputError(place, fmt::format("the picture is truncated: {} bytes cannot hold {} x {} pixels", file_bytes,
                                            width, height));
    }
}

}  // namespace wend
