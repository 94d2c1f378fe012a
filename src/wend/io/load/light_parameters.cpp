#include <wend/io/load/light_parameters.h>

#include <wend/io/load/colours.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {

float load_target(const pbrt::ParameterSet& p, std::string_view name) {
    const float value = p.get_float(name, 0);
    if (!std::isfinite(value)) {
        throw InputError(p.place_of(name), fmt::format("\"{}\" must be finite", name));
    }
    return std::max(value, 0.0f);
}

Rgb load_scaled(LoadContext& context, const pbrt::ParameterSet& p, std::string_view name) {
    return get_colour(context, p, name, SpectrumKind::illuminant).value_or(default_light(p)) *
           non_negative_float(p, "scale", 1);
}

Image load_picture(LoadContext& context, TextureLoader& textures, const pbrt::Entity& light) {
    Image image =
        *textures.picture(required_file(context, light, "filename"), light.parameters.get_string("encoding", "sRGB"),
                          light.parameters.place_of("encoding"), PictureChannels::of_light);
    for (Rgb& pixel : image.pixels) {
        if (!is_finite(pixel)) {
            throw InputError(light.parameters.place_of("filename"),
                             fmt::format("the picture of the {} light has a pixel that is not finite", light.type));
        }
        pixel = {std::max(pixel.r, 0.0f), std::max(pixel.g, 0.0f), std::max(pixel.b, 0.0f)};
    }
    return image;
}

void require_square(const Image& image, const pbrt::Entity& light) {
    if (image.width != image.height) {
        throw InputError(
            light.parameters.place_of("filename"),
            fmt::format("the picture of {} light must be square (equal-area mapping), not {} x {}",
                        light.type == "infinite" ? "an infinite" : "a goniometric", image.width, image.height));
    }
}

}  // namespace wend
