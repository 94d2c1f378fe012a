#include <wend/io/exr_file.h>
#include <wend/io/image_file.h>
#include <wend/io/load/colours.h>
#include <wend/io/load/textures.h>

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

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

bool holds_floats(const std::filesystem::path& file) {
    return is_exr(file) || file.extension() == ".hdr";
}

Image read_encoded(const std::filesystem::path& file, const std::string& encoding, const Place& place) {
    if (encoding == "sRGB") {
        return read_image(file, ColourEncoding::srgb);
    }
    const std::optional<float> gamma = gamma_of(encoding);
    if (!gamma && encoding != "linear") {
        throw InputError(place,
                         fmt::format("the encoding \"{}\" is unknown; known are sRGB, linear, gamma X", encoding));
    }
    Image image = read_image(file, ColourEncoding::linear);
    if (gamma && !holds_floats(file)) {
        for (Rgb& c : image.pixels) {
            c = {std::pow(c.r, *gamma), std::pow(c.g, *gamma), std::pow(c.b, *gamma)};
        }
    }
    return image;
}

ImageTexture::Wrap load_wrap(LoadContext& context, const pbrt::ParameterSet& p) {
    const std::string wrap = p.get_string("wrap", "repeat");
    if (wrap == "repeat") {
        return ImageTexture::Wrap::repeat;
    }
    if (wrap == "clamp") {
        return ImageTexture::Wrap::clamp;
    }
    if (wrap == "black") {
        return ImageTexture::Wrap::black;
    }
    if (wrap == "octahedralsphere") {
        context.warnings.add(p.place_of("wrap"),
                             "the wrap mode \"octahedralsphere\" is not implemented: \"repeat\" takes its place");
        return ImageTexture::Wrap::repeat;
    }
    throw InputError(p.place_of("wrap"),
                     fmt::format("the wrap mode \"{}\" is unknown; known are repeat, clamp, black", wrap));
}

}  // namespace

void TextureLoader::add(const pbrt::TextureEntity& texture) {
    by_name_.insert_or_assign({texture.kind, texture.name}, load(texture));
    context_.warnings.add_unused("Texture", texture);
}

TextureId TextureLoader::load(const pbrt::TextureEntity& texture) {
    if (texture.type == "constant") {
        return load_constant(texture);
    }
    if (texture.type == "scale") {
        return load_scale(texture);
    }
    if (texture.type == "mix") {
        return load_mix(texture);
    }
    if (texture.type == "imagemap") {
        return load_imagemap(texture);
    }
    if (texture.type == "checkerboard") {
        return load_checkerboard(texture);
    }
    return replace(texture);
}

TextureId TextureLoader::load_constant(const pbrt::TextureEntity& texture) {
    return operand(texture, "value", 1);
}

TextureId TextureLoader::load_scale(const pbrt::TextureEntity& texture) {
    const TextureId tex = operand(texture, "tex", 1);
    const TextureId scale = real(texture.parameters, "scale", 1);
    return add_node(ScaleTexture{tex, scale}, {tex, scale}, texture.place);
}

TextureId TextureLoader::load_mix(const pbrt::TextureEntity& texture) {
    const TextureId first = operand(texture, "tex1", 0);
    const TextureId second = operand(texture, "tex2", 1);
    const TextureId amount = real(texture.parameters, "amount", 0.5f);
    return add_node(MixTexture{first, second, amount}, {first, second, amount}, texture.place);
}

TextureId TextureLoader::load_imagemap(const pbrt::TextureEntity& texture) {
    const pbrt::ParameterSet& p = texture.parameters;
    ImageTexture image;
    image.image =
        picture(required_file(context_, texture, "filename"), p.get_string("encoding", "sRGB"), p.place_of("encoding"));
    image.mapping = load_mapping(texture);
    image.wrap = load_wrap(context_, p);
    image.scale = p.get_float("scale", 1);
    image.invert = p.get_bool("invert", false);
    // Pictures are interpolated bilinearly: with many samples a pixel, the finer filters average to the same.
    static_cast<void>(p.get_string("filter", "bilinear"));
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
        board.texture_from_world = AffineMap(texture.world_from_texture.inverse());
    } else if (board.dimensions == 2) {
        board.mapping = load_mapping(texture);
    } else {
        throw InputError(p.place_of("dimension"),
                         fmt::format("a checkerboard has 2 or 3 dimensions, not {}", board.dimensions));
    }
    return add_node(board, {board.even, board.odd}, texture.place);
}

TextureId TextureLoader::replace(const pbrt::TextureEntity& texture) {
    // The parameter that comes nearest to the texture as a whole; empty: half grey.
    struct Stand {
        std::string_view type;
        std::string_view parameter;
    };
    constexpr Stand stands[] = {{"bilerp", "v00"}, {"directionmix", "tex1"}, {"dots", "outside"},
                                {"fbm", ""},       {"marble", ""},           {"ptex", ""},
                                {"windy", ""},     {"wrinkled", ""}};
    for (const Stand& stand : stands) {
        if (stand.type != texture.type) {
            continue;
        }
        context_.warnings.add(
            texture.place,
            stand.parameter.empty()
                ? fmt::format("Texture \"{}\" is not implemented: the constant 0.5 takes its place", texture.type)
                : fmt::format("Texture \"{}\" is not implemented: its \"{}\" takes its place", texture.type,
                              stand.parameter));
        return stand.parameter.empty() ? textures_.add_constant(Rgb(0.5f)) : operand(texture, stand.parameter, 0);
    }
    refuse_type("Texture", texture,
                {"bilerp", "checkerboard", "constant", "directionmix", "dots", "fbm", "imagemap", "marble", "mix",
                 "ptex", "scale", "windy", "wrinkled"});
}

UvMapping TextureLoader::load_mapping(const pbrt::TextureEntity& texture) {
    const pbrt::ParameterSet& p = texture.parameters;
    const std::string kind = p.get_string("mapping", "uv");
    if (kind == "spherical" || kind == "cylindrical" || kind == "planar") {
        context_.warnings.add(
            p.place_of("mapping"),
            fmt::format("the texture mapping \"{}\" is not implemented: \"uv\" takes its place", kind));
    } else if (kind != "uv") {
        throw InputError(
            p.place_of("mapping"),
            fmt::format("the texture mapping \"{}\" is unknown; known are uv, spherical, cylindrical, planar", kind));
    }
    return {p.get_float("uscale", 1), p.get_float("vscale", 1), p.get_float("udelta", 0), p.get_float("vdelta", 0)};
}

TextureId TextureLoader::add_node(Texture texture, std::initializer_list<TextureId> operands, const Place& place) {
    // A texture that uses the one before twice doubles the work with each step.
    constexpr int most_evaluations = 10000;
    int evaluations = 1;
    for (const TextureId operand : operands) {
        const auto found = evaluations_.find(operand);
        evaluations += found == evaluations_.end() ? 1 : found->second;
    }
    if (evaluations > most_evaluations) {
        throw InputError(place, fmt::format("the texture consists of more than {} parts", most_evaluations));
    }
    const TextureId id = textures_.add(std::move(texture));
    evaluations_.emplace(id, evaluations);
    return id;
}

TextureId TextureLoader::operand(const pbrt::TextureEntity& texture, std::string_view name, float fallback) {
    return texture.kind == pbrt::TextureKind::real ? real(texture.parameters, name, fallback)
                                                   : colour(texture.parameters, name, Rgb(fallback));
}

TextureId TextureLoader::named(const std::string& name, pbrt::TextureKind kind, const Place& place) const {
    const auto found = by_name_.find({kind, name});
    if (found == by_name_.end()) {
        throw InputError(place, fmt::format("the texture \"{}\" is not one of kind {}", name,
                                            kind == pbrt::TextureKind::real ? "float" : "spectrum"));
    }
    return found->second;
}

std::optional<TextureId> TextureLoader::find_colour(const pbrt::ParameterSet& parameters, std::string_view name,
                                                    SpectrumKind kind) {
    const auto value = parameters.get_colour_or_texture(name);
    if (!value) {
        return std::nullopt;
    }
    const pbrt::Location& place = parameters.place_of(name);
    if (const auto* texture = std::get_if<pbrt::TextureName>(&*value)) {
        return named(texture->name, pbrt::TextureKind::spectrum, place);
    }
    return textures_.add_constant(reduce_colour(context_, std::get<pbrt::ColourValue>(*value), kind, place));
}

std::optional<TextureId> TextureLoader::find_real(const pbrt::ParameterSet& parameters, std::string_view name) {
    return parameters.has(name) ? std::optional(real(parameters, name, 0)) : std::nullopt;
}

TextureId TextureLoader::colour(const pbrt::ParameterSet& parameters, std::string_view name, const Rgb& fallback) {
    const std::optional<TextureId> found = find_colour(parameters, name, SpectrumKind::reflectance);
    return found ? *found : textures_.add_constant(fallback);
}

TextureId TextureLoader::real(const pbrt::ParameterSet& parameters, std::string_view name, float fallback) {
    const auto value = parameters.get_float_or_texture(name, fallback);
    if (const auto* texture = std::get_if<pbrt::TextureName>(&value)) {
        return named(texture->name, pbrt::TextureKind::real, parameters.place_of(name));
    }
    const float number = std::get<float>(value);
    if (!std::isfinite(number)) {
        throw InputError(parameters.place_of(name), fmt::format("\"{}\" must be finite", name));
    }
    return textures_.add_constant(Rgb(number));
}

Rgb TextureLoader::mean(TextureId id) const {
    if (const Rgb* constant = textures_.constant(id)) {
        return *constant;
    }
    constexpr int side = 64;
    Rgb sum;
    for (int y = 0; y < side; ++y) {
        for (int x = 0; x < side; ++x) {
            const Vec2 uv((static_cast<float>(x) + 0.5f) / side, (static_cast<float>(y) + 0.5f) / side);
            sum += textures_.evaluate(id, {uv, {0, 0, 0}});
        }
    }
    return sum / static_cast<float>(side * side);
}

std::shared_ptr<const Image> TextureLoader::picture(const std::filesystem::path& file, const std::string& encoding,
                                                    const Place& place) {
    std::shared_ptr<const Image>& image = pictures_[{file.lexically_normal().string(), encoding}];
    if (!image) {
        image = std::make_shared<const Image>(read_encoded(file, encoding, place));
    }
    return image;
}

}  // namespace wend
