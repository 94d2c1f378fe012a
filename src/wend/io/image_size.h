#pragma once

#include <wend/core/error.h>

#include <cstdint>

namespace wend {

/// Whether a file of so many bytes may hold so many pixels.
bool is_credible_size(std::int64_t pixels, std::uintmax_t file_bytes);

/// Throws InputError unless the size that a picture's header declares is positive, at most `max_pixels`, and credible
/// for a file of that many bytes: to be called before memory is taken for the pixels. So it is bounded by the file's
/// size: a picture takes 32 bytes a pixel or less while it is read, of which there are 2^25 and 64 a byte at most.
void check_image_size(std::int64_t width, std::int64_t height, std::uintmax_t file_bytes, const Place& place);

}  // namespace wend
