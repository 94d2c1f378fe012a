// The first picture of GIF files. Other modules use image_file.h.
#pragma once

#include <wend/core/error.h>
#include <wend/io/image_file.h>

#include <string_view>

namespace wend {

/// Whether a file begins as GIF files do.
bool is_gif(std::string_view file);

/// Reads the first picture of one, as sRGB, on the whole of its screen. What it leaves out, and what is transparent,
/// has the screen's background colour, or is black and has no opacity if that is the first of its colours. Throws
/// InputError for a file without a picture, a size that is not credible (check_image_size), codes that make no sense
/// and too few bytes.
ImageWithOpacity read_gif(std::string_view file, const Place& place);

}  // namespace wend
