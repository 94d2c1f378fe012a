// Portable float maps. Other modules use image_file.h.
#pragma once

#include <wend/core/error.h>
#include <wend/core/image.h>

#include <string_view>

namespace wend {

/// Whether a file begins as a portable float map does.
bool is_pfm(std::string_view file);

/// Reads one: "PF" (colour) or "Pf" (grey, which fills all channels), the size, and a factor whose sign tells the byte
/// order, each followed by white space; then the rows from the bottom up. Throws InputError for another header, a size
/// that is not credible (check_image_size) and too few bytes.
Image read_pfm(std::string_view file, const Place& place);

}  // namespace wend
