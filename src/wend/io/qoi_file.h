// "Quite OK Image" files. Other modules use image_file.h.
#pragma once

#include <wend/core/error.h>
#include <wend/io/image_file.h>

#include <string_view>

namespace wend {

/// Whether a file begins as such files do.
bool is_qoi(std::string_view file);

/// Reads one. The header tells whether it is sRGB or linear, and whether there is an opacity, which is encoded like the
/// colours. Throws InputError for another header, a size that is not credible (check_image_size) and too few bytes.
ImageWithOpacity read_qoi(std::string_view file, const Place& place);

}  // namespace wend
