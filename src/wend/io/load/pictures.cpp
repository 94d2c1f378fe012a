#include <wend/io/load/pictures.h>

#include <wend/io/colour_encoding.h>
#include <wend/io/exr_file.h>
#include <wend/io/load/colours.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <optional>
#include <utility>

namespace wend {
namespace {

/// The exponent in "gamma X"; none for another text.
std::optional<float> gamma_of(const std::string& encoding) {
    constexpr std::string_view prefix = "gamma ";
    if (!encoding.starts_with(prefix)) {
        return std::nullopt;
    }
    const char* text = encoding.c_str() + prefix.size();
    char* end = nullptr;
    const float gamma = std::strtof(text, &end);
    return end != text && *end == '\0' && gamma > 0 && std::isfinite(gamma) ? std::optional(gamma) : std::nullopt;
}

/// By a gamma, of PNG files alone. Their opacity is encoded as the colours are.
void apply_gamma(ImageWithOpacity& picture, float gamma) {
    for (Rgb& c : picture.image.pixels) {
        c = {std::pow(c.r, gamma), std::pow(c.g, gamma), std::pow(c.b, gamma)};
    }
    for (float& opacity : picture.opacity) {
        opacity = std::pow(opacity, gamma);
    }
}

/// Numbers as the file has them, whatever they are in others.
ImageWithOpacity read_raw(const std::filesystem::path& file) {
    ImageWithOpacity picture = read_image_with_opacity(file, ColourEncoding::linear);
    if (!is_png(file) && implied_encoding(file) == "sRGB") {
        for (Rgb& c : picture.image.pixels) {
            c = {linear_to_srgb(c.r), linear_to_srgb(c.g), linear_to_srgb(c.b)};
        }
    }
    return picture;
}

/// The colours of a picture as they are, or one number a pixel in all channels.
Image reduce_picture(ImageWithOpacity picture, PictureChannels channels) {
    std::vector<Rgb>& pixels = picture.image.pixels;
    const bool takes_colours = channels == PictureChannels::colours || channels == PictureChannels::of_surfaces ||
                               channels == PictureChannels::of_light;
    for (std::size_t i = 0; i < pixels.size() && !takes_colours; ++i) {
        if (channels == PictureChannels::luminance) {
            pixels[i] = Rgb(luminance(pixels[i]));
            continue;
        }
        const bool is_first = channels == PictureChannels::first;
        const bool is_grey = pixels[i].r == pixels[i].g && pixels[i].g == pixels[i].b;
        const float colour = is_first || is_grey ? pixels[i].r : mean(pixels[i]);
        pixels[i] = Rgb(is_first || picture.opacity.empty() ? colour : picture.opacity[i]);
    }
    return std::move(picture.image);
}

}  // namespace

std::string_view implied_encoding(const std::filesystem::path& file) {
    const bool holds_floats = is_exr(file) || file.extension() == ".hdr" || file.extension() == ".pfm";
    return holds_floats ? "linear" : "sRGB";
}

ImageWithOpacity read_encoded(const std::filesystem::path& file, const std::string& encoding, const Place& place) {
    if (encoding == "sRGB") {
        return read_image_with_opacity(file, ColourEncoding::srgb);
    }
    if (encoding == "raw") {
        return read_raw(file);
    }
    const std::optional<float> gamma = gamma_of(encoding);
    if (!gamma && encoding != "linear") {
        throw InputError(place,
                         fmt::format("the encoding \"{}\" is unknown; known are sRGB, linear, raw, gamma X", encoding));
    }
    ImageWithOpacity picture = read_image_with_opacity(file, ColourEncoding::linear);
    if (gamma && is_png(file)) {
        apply_gamma(picture, *gamma);
    }
    return picture;
}

Image read_channels(const std::filesystem::path& file, const std::string& encoding, const Place& place,
                    PictureChannels channels) {
    Image image = reduce_picture(read_encoded(file, encoding, place), channels);
    const bool is_light = channels == PictureChannels::of_light;
    if ((is_light || channels == PictureChannels::of_surfaces) && is_exr(file)) {
        const pbrt::ColourSpace space = exr_colour_space(file);
        for (std::size_t i = 0; i < image.pixels.size() && space != pbrt::ColourSpace::srgb; ++i) {
            image.pixels[i] =
                rec709_of({image.pixels[i], space}, is_light ? SpectrumKind::illuminant : SpectrumKind::reflectance);
        }
    }
    return image;
}

bool is_from_top(const pbrt::ParameterSet& parameters, std::string_view name) {
    const std::string origin = parameters.get_string(name, "bottom");
    if (origin != "bottom" && origin != "top") {
        throw InputError(parameters.place_of(name), fmt::format("\"{}\" is bottom or top, not \"{}\"", name, origin));
    }
    return origin == "top";
}

Image upside_down(const Image& image) {
    Image result = image;
    for (int y = 0; y < image.height; ++y) {
        std::copy_n(&image.at(0, y), image.width, &result.at(0, image.height - 1 - y));
    }
    return result;
}

}  // namespace wend
