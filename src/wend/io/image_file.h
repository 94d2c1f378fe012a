// Picture files: OpenEXR through its library, PNG, JPEG, TGA, BMP, PSD and Radiance HDR through stb, and of our own
// PFM, PGM, PPM, GIF and QOI.
#pragma once

#include <wend/film/picture.h>
#include <wend/io/picture_format.h>

#include <filesystem>
#include <string>
#include <vector>

namespace wend {

/// How the numbers of a PNG file map to linear colour. Files of floating point are linear, and all others sRGB, or say
/// themselves what they are: pbrt does not ask there.
enum class ColourEncoding { srgb, linear };

/// Reads the colour of a picture file as linear colour; a grey file fills all three channels, and opacity is dropped.
/// The kind is recognized by content. For EXR: channels R, G, B (or Y, or the only one) of the data window. Throws
/// InputError naming the file when it is missing, broken, truncated, larger than `max_pixels` or of an unknown kind.
Image read_image(const std::filesystem::path& file, ColourEncoding encoding = ColourEncoding::srgb);

/// A picture with its opacity: one value a pixel, decoded as its colours are (so pbrt has it), or none.
struct ImageWithOpacity {
    Image image;
    std::vector<float> opacity;
};

/// The same with the opacity of OpenEXR (the channel A), PNG (but not by a palette), TGA, BMP, PSD, GIF and QOI, unless
/// that is 1 everywhere.
ImageWithOpacity read_image_with_opacity(const std::filesystem::path& file,
                                         ColourEncoding encoding = ColourEncoding::srgb);

/// Whether a file begins as PNG files do; false where it cannot be read.
bool is_png(const std::filesystem::path& file);

/// The whole of an EXR file: beauty, layers and metadata, as write_picture left them, in whatever format that was; of
/// pbrt's and Blender's files as well (of one view layer, the first). Channels without a layer's name (other than the
/// beauty's) are in a layer named "", or in that of their part; parts of another size are left out. Throws InputError
/// as read_image does, and for files that are not EXR.
Picture read_picture(const std::filesystem::path& file);

/// Writes by extension (a device without one takes OpenEXR): .exr (all layers as `layer.channel`, metadata as string
/// attributes; samples, seed and seconds as numbers, too, under names that others know: `samplesPerPixel`, `seed`,
/// `renderTimeSeconds`), .png and .jpg (beauty in sRGB, clamped to [0,1]). The file appears whole or not at
/// all: it is written beside and renamed. Throws InputError for an unknown extension, std::runtime_error when the disk
/// refuses.
void write_picture(const std::filesystem::path& file, const Picture& picture, const PictureFormat& format = {});

/// Writes the colours and the metadata alone, as references are kept: OpenEXR in half floats, or in 32-bit floats where
/// a colour is too large for them. The file appears whole or not at all. Throws InputError for any extension but .exr,
/// std::runtime_error when the disk refuses.
void write_colours(const std::filesystem::path& file, const Picture& picture);

/// Pictures with more pixels are refused before any memory is taken.
inline constexpr long long max_pixels = 1ll << 28;

/// Whether write_picture() knows the extension.
bool is_known_picture_extension(const std::filesystem::path& file);
/// Throws InputError, naming the extensions there are, unless it does: to ask before a long render.
void require_known_picture_extension(const std::filesystem::path& file);

/// Whether a picture of this name has layers, and colours that are not of eight bits.
bool is_exr_name(const std::filesystem::path& file);
/// Throws InputError unless write_colours() takes the extension.
void require_exr_extension(const std::filesystem::path& file);

/// The bytes of a PNG file of an image in sRGB, clamped to [0,1].
std::string png_bytes(const Image& image);

}  // namespace wend
