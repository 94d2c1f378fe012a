#pragma once

#include <wend/core/error.h>

#include <cstdint>

namespace wend {

/// Throws InputError unless the size that a picture's header declares is positive, at most `max_pixels`, and credible
/// for a file of that many bytes: to be called before memory is taken for the pixels.
void check_image_size(std::int64_t width, std::int64_t height, std::uintmax_t file_bytes, const Place& place);

}  // namespace wend
