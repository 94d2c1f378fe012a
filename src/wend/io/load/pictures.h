// Pictures that scene files name, as they want them.
#pragma once

#include <wend/io/image_file.h>
#include <wend/io/load/context.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace wend {

/// What of a picture is wanted: its colours, or the one number that pbrt takes of it for a float texture. That is
/// the opacity if there is one that is not 1 everywhere, or else the mean of the colours; but the first of them by
/// the filters that take single pixels. Or, beyond pbrt, the luminance of the colours. Colours of surfaces and of light
/// become those of Rec. 709 where an OpenEXR file says that it has others; `colours` are what the file has.
enum class PictureChannels { colours, number, first, luminance, of_surfaces, of_light };

/// Reads what is wanted of a picture, by read_encoded().
Image read_channels(const std::filesystem::path& file, const std::string& encoding, const Place& place,
                    PictureChannels channels);

/// `encoding` is pbrt's, of PNG files: "sRGB", "linear" or "gamma X"; or "raw", of any file, whose numbers are taken as
/// they are. Throws InputError at the place for another, and where the file cannot be read.
ImageWithOpacity read_encoded(const std::filesystem::path& file, const std::string& encoding, const Place& place);

/// That of a picture which is not PNG.
std::string_view implied_encoding(const std::filesystem::path& file);

/// A parameter that says where rows of a picture are counted from, beyond pbrt: "bottom" or "top", for v upwards or
/// downwards. Throws InputError for another.
bool is_from_top(const pbrt::ParameterSet& parameters, std::string_view name);

/// The first row below.
Image upside_down(const Image& image);

}  // namespace wend
