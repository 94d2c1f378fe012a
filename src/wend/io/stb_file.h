// The picture formats that stb reads and writes. Other modules use image_file.h.
#pragma once

#include <wend/io/image_file.h>

#include <filesystem>
#include <string>

namespace wend {

/// See read_image: PNG (8 and 16 bits), JPEG, TGA, BMP and Radiance HDR.
Image read_stb_image(const std::filesystem::path& file, ColourEncoding encoding);

/// A picture as the bytes of a file, in sRGB and clamped to [0,1]; what is not a number becomes black.
std::string encode_png(const Image& image);
std::string encode_jpeg(const Image& image);

}  // namespace wend
