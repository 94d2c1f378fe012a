// OpenEXR pictures. Other modules use image_file.h.
#pragma once

#include <wend/film/picture.h>
#include <wend/io/image_file.h>
#include <wend/io/pbrt/colour_value.h>

#include <filesystem>

namespace wend {

/// Whether a file begins as every OpenEXR file does; false where it cannot be read.
bool is_exr(const std::filesystem::path& file);

/// See read_image_with_opacity and read_picture.
ImageWithOpacity read_exr_image(const std::filesystem::path& file);
Picture read_exr(const std::filesystem::path& file);

/// Of which its header says that the colours are; sRGB's where it says nothing, or names one that pbrt does not know.
pbrt::ColourSpace exr_colour_space(const std::filesystem::path& file);

/// Writes to exactly this file. Throws std::runtime_error when that fails.
void write_exr(const std::filesystem::path& file, const Picture& picture, const PictureFormat& format);

/// The same for the colours and the metadata alone; see write_colours.
void write_exr_colours(const std::filesystem::path& file, const Picture& picture);

}  // namespace wend
