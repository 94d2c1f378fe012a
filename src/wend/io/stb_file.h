// The picture formats that stb reads and writes. Other modules use image_file.h.
#pragma once

#include <wend/core/error.h>
#include <wend/io/image_file.h>

#include <string>

namespace wend {

/// See read_image_with_opacity: the bytes of a file that is PNG (8 and 16 bits), JPEG, TGA, BMP, PSD or Radiance HDR.
ImageWithOpacity read_stb_image(std::string bytes, const Place& place, ColourEncoding encoding);

/// A picture as the bytes of a file, in sRGB and clamped to [0,1]; what is not a number becomes black.
std::string encode_png(const Image& image);
std::string encode_jpeg(const Image& image);

}  // namespace wend
