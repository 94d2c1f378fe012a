#include <wend/io/load/textures.h>

#include <wend/io/image_file.h>
#include <wend/io/load/colours.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

ImageTexture::Wrap load_wrap(const pbrt::ParameterSet& p) {
    const std::string wrap = p.get_string("wrap", "repeat");
    if (wrap == "repeat") {
        return ImageTexture::Wrap::repeat;
    }
    if (wrap == "mirror") {
        return ImageTexture::Wrap::mirror;
    }
    if (wrap == "clamp") {
        return ImageTexture::Wrap::clamp;
    }
    if (wrap == "black") {
        return ImageTexture::Wrap::black;
    }
    if (wrap == "octahedralsphere") {
        return ImageTexture::Wrap::octahedral_sphere;
    }
    throw InputError(
        p.place_of("wrap"),
        fmt::format("the wrap mode \"{}\" is unknown; known are repeat, mirror, clamp, black, octahedralsphere", wrap));
}

/// Pictures are interpolated bilinearly unless the nearest pixel is wanted: with many samples a pixel, the finer
/// filters average to the same.
std::string load_filter(LoadContext& context, const pbrt::ParameterSet& p) {
    const std::string filter = p.get_string("filter", "bilinear");
    if (filter != "point" && filter != "bilinear" && filter != "trilinear" && filter != "EWA" && filter != "ewa") {
        context.warnings.add(p.place_of("filter"),
                             fmt::format("the filter \"{}\" is unknown; known are point, bilinear, "
                                         "trilinear, EWA: bilinear takes its place, as in pbrt",
                                         filter));
        return "bilinear";
    }
    return filter;
}

Octaves load_octaves(const pbrt::ParameterSet& p) {
    constexpr int most = 64;
    const Octaves octaves{p.get_int("octaves", 8), p.get_float("roughness", 0.5f)};
    if (octaves.count < 0 || octaves.count > most) {
        throw InputError(p.place_of("octaves"), fmt::format("\"octaves\" must be from 0 to {}", most));
    }
    constexpr float largest_falloff = 3;  // keeps the sum of all octaves finite
    if (!(std::abs(octaves.falloff) <= largest_falloff)) {
        throw InputError(p.place_of("roughness"), fmt::format("the \"roughness\" of a texture must be from {} to {}",
                                                              -largest_falloff, largest_falloff));
    }
    return octaves;
}

AffineMap texture_from_world(const pbrt::TextureEntity& texture) {
    return AffineMap(texture.world_from_texture.inverse());
}

float finite_float(const pbrt::ParameterSet& p, std::string_view name, float fallback) {
    const float value = p.get_float(name, fallback);
    if (!std::isfinite(value)) {
        throw InputError(p.place_of(name), fmt::format("\"{}\" must be finite", name));
    }
    return value;
}

}  // namespace

TextureId TextureLoader::load(const pbrt::TextureEntity& texture) {
    struct Loader {
        std::string_view type;
        TextureId (TextureLoader::*load)(const pbrt::TextureEntity&);
    };
    static constexpr Loader loaders[] = {
        {"bilerp", &TextureLoader::load_bilerp},     {"checkerboard", &TextureLoader::load_checkerboard},
        {"constant", &TextureLoader::load_constant}, {"directionmix", &TextureLoader::load_direction_mix},
        {"dots", &TextureLoader::load_dots},         {"facing", &TextureLoader::load_facing},
        {"fbm", &TextureLoader::load_fractal},       {"imagemap", &TextureLoader::load_imagemap},
        {"marble", &TextureLoader::load_marble},     {"mesh", &TextureLoader::load_mesh},
        {"mix", &TextureLoader::load_mix},           {"ptex", &TextureLoader::load_ptex},
        {"scale", &TextureLoader::load_scale},       {"sides", &TextureLoader::load_sides},
        {"windy", &TextureLoader::load_windy},       {"wrinkled", &TextureLoader::load_wrinkled},
    };
    for (const Loader& loader : loaders) {
        if (loader.type == texture.type) {
            return (this->*loader.load)(texture);
        }
    }
    refuse_type("Texture", texture,
                {"bilerp", "checkerboard", "constant", "directionmix", "dots", "facing", "fbm", "imagemap", "marble",
                 "mesh", "mix", "ptex", "scale", "sides", "windy", "wrinkled"});
}

TextureId TextureLoader::load_constant(const pbrt::TextureEntity& texture) {
    return operand(texture, "value", 1);
}

TextureId TextureLoader::load_scale(const pbrt::TextureEntity& texture) {
    const TextureId tex = operand(texture, "tex", 1);
    const TextureId scale = number_operand(texture, "scale", 1);
    // pbrt takes a constant factor for that of the picture itself, which it inverts afterwards.
    const auto scaled = [&](TextureId picture, TextureId factor) -> std::optional<TextureId> {
        const ImageTexture* image = textures_.picture(picture);
        const Rgb* constant = textures_.constant(factor);
        if (!image || !constant) {
            return std::nullopt;
        }
        ImageTexture copy = *image;
        copy.scale *= constant->r;
        if (!std::isfinite(copy.scale)) {
            return std::nullopt;
        }
        return textures_.add(std::move(copy));
    };
    std::optional<TextureId> whole = scaled(tex, scale);
    if (!whole && texture.kind == pbrt::TextureKind::real) {
        whole = scaled(scale, tex);
    }
    return whole ? *whole : add_node(ScaleTexture{tex, scale}, {tex, scale}, texture.place);
}

TextureId TextureLoader::load_mix(const pbrt::TextureEntity& texture) {
    const TextureId first = operand(texture, "tex1", 0);
    const TextureId second = operand(texture, "tex2", 1);
    const TextureId amount = number_operand(texture, "amount", 0.5f);
    return add_node(MixTexture{first, second, amount}, {first, second, amount}, texture.place);
}

TextureLoader::Channels TextureLoader::load_channels(const pbrt::TextureEntity& texture,
                                                     const std::string& filter) const {
    const pbrt::ParameterSet& p = texture.parameters;
    const std::string channels = p.get_string("channels", "");
    if (channels != "" && channels != "luminance") {
        throw InputError(p.place_of("channels"),
                         fmt::format("the channels \"{}\" are unknown; known is luminance", channels));
    }
    return texture.kind == pbrt::TextureKind::spectrum     ? Channels::of_surfaces
           : channels == "luminance"                       ? Channels::luminance
           : filter == "point"                             ? Channels::first
           : filter == "bilinear" || filter == "trilinear" ? Channels::number
           : use_ == Use::presence                         ? Channels::number
                                                           : Channels::first;
}

TextureId TextureLoader::load_imagemap(const pbrt::TextureEntity& texture) {
    const pbrt::ParameterSet& p = texture.parameters;
    ImageTexture image;
    const std::string filter = load_filter(context_, p);
    image.nearest = filter == "point";
    const Channels channels = load_channels(texture, filter);
    const std::filesystem::path file = required_file(context_, texture, "filename");
    image.image = picture(file, p.get_string("encoding", "sRGB"), p.place_of("encoding"), channels);
    if (p.has("encoding") && !is_png(file) && p.get_string("encoding", "") != "raw" &&
        p.get_string("encoding", "") != implied_encoding(file)) {
        context_.warnings.add(p.place_of("encoding"),
                              "the encoding of a picture that is not PNG is not asked for: "
                              "numbers of 8 bits are sRGB, others linear");
    }
    const auto& pixels = image.image->pixels;
    if (!std::all_of(pixels.begin(), pixels.end(), [](const Rgb& pixel) { return is_finite(pixel); })) {
        context_.warnings.add(p.place_of("filename"),
                              "pixels of the picture that are not finite numbers are taken for black");
        auto mended = std::make_shared<Image>(*image.image);
        std::replace_if(
            mended->pixels.begin(), mended->pixels.end(), [](const Rgb& pixel) { return !is_finite(pixel); },
            Rgb(0.0f));
        image.image = std::move(mended);
    }
    image.mapping = load_mapping(texture);
    image.wrap = load_wrap(p);
    image.scale = finite_float(p, "scale", 1);
    image.invert = p.get_bool("invert", false);
    if (texture.kind == pbrt::TextureKind::spectrum) {
        image.least = 0;
        image.most = use_ == Use::surface ? 1 : infinity;
    } else if (image.invert) {
        image.least = 0;
    }
    static_cast<void>(p.get_float("maxanisotropy", 8));
    return textures_.add(std::move(image));
}

TextureId TextureLoader::load_checkerboard(const pbrt::TextureEntity& texture) {
    const pbrt::ParameterSet& p = texture.parameters;
    CheckerboardTexture board;
    board.even = operand(texture, "tex1", 1);
    board.odd = operand(texture, "tex2", 0);
    board.dimensions = p.get_int("dimension", 2);
    if (board.dimensions == 3) {
        board.texture_from_world = texture_from_world(texture);
    } else if (board.dimensions == 2) {
        board.mapping = load_mapping(texture);
    } else {
        throw InputError(p.place_of("dimension"),
                         fmt::format("a checkerboard has 2 or 3 dimensions, not {}", board.dimensions));
    }
    return add_node(board, {board.even, board.odd}, texture.place);
}

TextureId TextureLoader::load_sides(const pbrt::TextureEntity& texture) {
    const SidesTexture sides{operand(texture, "tex1", 0), operand(texture, "tex2", 1)};
    return add_node(sides, {sides.front, sides.back}, texture.place);
}

TextureId TextureLoader::load_direction_mix(const pbrt::TextureEntity& texture) {
    const pbrt::ParameterSet& p = texture.parameters;
    DirectionMixTexture mix;
    mix.first = operand(texture, "tex1", 0);
    mix.second = operand(texture, "tex2", 1);
    const Vec3 direction = texture.world_from_texture.vector(p.get_vector3("dir", {0, 1, 0}));
    if (!is_finite(direction) || !(length_squared(direction) > 0)) {
        throw InputError(p.place_of("dir"), "\"dir\" must be a direction");
    }
    mix.direction = normalize(direction);
    return add_node(mix, {mix.first, mix.second}, texture.place);
}

Rgb TextureLoader::plain_value(const pbrt::TextureEntity& texture, std::string_view name, float fallback) {
    const pbrt::ParameterSet& p = texture.parameters;
    return texture.kind == pbrt::TextureKind::real
               ? Rgb(finite_float(p, name, fallback))
               : get_colour(context_, p, name, kind_of_colours()).value_or(Rgb(fallback));
}

TextureId TextureLoader::load_bilerp(const pbrt::TextureEntity& texture) {
    return textures_.add(BilerpTexture{plain_value(texture, "v00", 0), plain_value(texture, "v01", 1),
                                       plain_value(texture, "v10", 0), plain_value(texture, "v11", 1),
                                       load_mapping(texture)});
}

TextureId TextureLoader::load_dots(const pbrt::TextureEntity& texture) {
    // The names are the wrong way round, in pbrt-v4 as in those before: pictures were made for that.
    DotsTexture dots;
    dots.ground = operand(texture, "inside", 1);
    dots.dot = operand(texture, "outside", 0);
    dots.mapping = load_mapping(texture);
    return add_node(dots, {dots.dot, dots.ground}, texture.place);
}

TextureId TextureLoader::load_fractal(const pbrt::TextureEntity& texture) {
    return textures_.add(
        NoiseTexture{NoiseTexture::Kind::fractal, load_octaves(texture.parameters), texture_from_world(texture)});
}

TextureId TextureLoader::load_wrinkled(const pbrt::TextureEntity& texture) {
    return textures_.add(
        NoiseTexture{NoiseTexture::Kind::wrinkled, load_octaves(texture.parameters), texture_from_world(texture)});
}

TextureId TextureLoader::load_windy(const pbrt::TextureEntity& texture) {
    return textures_.add(NoiseTexture{NoiseTexture::Kind::windy, {}, texture_from_world(texture)});
}

TextureId TextureLoader::load_marble(const pbrt::TextureEntity& texture) {
    const pbrt::ParameterSet& p = texture.parameters;
    return textures_.add(MarbleTexture{load_octaves(p), finite_float(p, "scale", 1), finite_float(p, "variation", 0.2f),
                                       texture_from_world(texture)});
}

/// What a mesh has at its vertices or on its faces.
std::shared_ptr<const std::vector<Rgb>> TextureLoader::load_values(const pbrt::TextureEntity& texture) const {
    const pbrt::ParameterSet& p = texture.parameters;
    const std::vector<float> numbers = p.get_floats("values");
    const std::size_t channels = texture.kind == pbrt::TextureKind::real ? 1 : 3;
    if (numbers.empty() || numbers.size() % channels != 0 ||
        !std::all_of(numbers.begin(), numbers.end(), [](float x) { return std::isfinite(x); })) {
        throw InputError(p.place_of("values"), fmt::format("\"values\" are finite numbers, {} each", channels));
    }
    auto values = std::make_shared<std::vector<Rgb>>();
    for (std::size_t i = 0; i < numbers.size(); i += channels) {
        values->emplace_back(numbers[i], numbers[i + (channels - 1) / 2], numbers[i + channels - 1]);
    }
    return values;
}

TextureId TextureLoader::load_facing(const pbrt::TextureEntity& texture) {
    return textures_.add(FacingTexture{load_values(texture)});
}

TextureId TextureLoader::load_mesh(const pbrt::TextureEntity& texture) {
    const pbrt::ParameterSet& p = texture.parameters;
    std::shared_ptr<const std::vector<Rgb>> values = load_values(texture);
    auto indices = std::make_shared<std::vector<std::uint32_t>>();
    for (const int index : p.get_ints("indices")) {
        if (index < 0 || static_cast<std::size_t>(index) >= values->size()) {
            throw InputError(p.place_of("indices"),
                             fmt::format("the index {} is out of range: there are {} values", index, values->size()));
        }
        indices->push_back(static_cast<std::uint32_t>(index));
    }
    if (indices->empty() || indices->size() % 3 != 0) {
        throw InputError(p.place_of("indices"), "\"indices\" are three for each triangle");
    }
    return textures_.add(MeshTexture{std::move(values), std::move(indices)});
}

TextureId TextureLoader::load_ptex(const pbrt::TextureEntity& texture) {
    context_.warnings.add(texture.place, "Texture \"ptex\" is not implemented: the constant 0.5 takes its place");
    static_cast<void>(texture.parameters.get_string("filename", ""));
    return textures_.add_constant(Rgb(0.5f));
}

TextureMapping TextureLoader::load_mapping(const pbrt::TextureEntity& texture) {
    const pbrt::ParameterSet& p = texture.parameters;
    const std::string kind = p.get_string("mapping", "uv");
    if (const std::vector<float> m = p.get_floats("uvmatrix"); kind == "uv" && !m.empty()) {
        if (m.size() != 6 || !std::all_of(m.begin(), m.end(), [](float x) { return std::isfinite(x); })) {
            throw InputError(p.place_of("uvmatrix"), "\"uvmatrix\" is six finite numbers");
        }
        return UvMapping{m[0], m[4], m[2], m[5], m[1], m[3]};
    }
    if (kind == "uv") {
        return UvMapping{finite_float(p, "uscale", 1), finite_float(p, "vscale", 1), finite_float(p, "udelta", 0),
                         finite_float(p, "vdelta", 0)};
    }
    if (kind == "spherical") {
        return SphericalMapping{texture_from_world(texture)};
    }
    if (kind == "cylindrical") {
        return CylindricalMapping{texture_from_world(texture)};
    }
    if (kind == "planar") {
        return PlanarMapping{texture_from_world(texture), p.get_vector3("v1", {1, 0, 0}),
                             p.get_vector3("v2", {0, 1, 0}), finite_float(p, "udelta", 0),
                             finite_float(p, "vdelta", 0)};
    }
    context_.warnings.add(p.place_of("mapping"),
                          fmt::format("the texture mapping \"{}\" is unknown; known are uv, spherical, cylindrical, "
                                      "planar: the texture coordinates as they are take its place, as in pbrt",
                                      kind));
    return UvMapping{};
}

}  // namespace wend
