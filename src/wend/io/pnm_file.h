// Portable grey maps and pixel maps. Other modules use image_file.h.
#pragma once

#include <wend/core/error.h>
#include <wend/core/image.h>

#include <string_view>

namespace wend {

/// Whether a file begins as one of P2, P3, P5 and P6 does.
bool is_pnm(std::string_view file);

/// Reads one, of one or two bytes a value or in text, as sRGB. Grey fills all channels; values above the largest that
/// the header names count as that. Throws InputError for another header, a size that is not credible
/// (check_image_size) and too few values.
Image read_pnm(std::string_view file, const Place& place);

}  // namespace wend
