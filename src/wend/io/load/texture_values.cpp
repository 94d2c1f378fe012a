#include <wend/io/load/colours.h>
#include <wend/io/load/loaded_parts.h>
#include <wend/io/load/textures.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {

void TextureLoader::add(const std::vector<pbrt::TextureEntity>& textures) {
    for (const pbrt::TextureEntity& texture : textures) {
        entities_.emplace(std::pair(texture.kind, texture.name), &texture);
    }
    for (const pbrt::TextureEntity& texture : textures) {
        named(texture.name, texture.kind, texture.place,
              texture.kind == pbrt::TextureKind::real ? Use::number : Use::surface);
        context_.warnings.add_unused("Texture", texture);
    }
}

TextureId TextureLoader::named(const std::string& name, pbrt::TextureKind kind, const Place& place, Use use) {
    const auto found = entities_.find({kind, name});
    if (found == entities_.end()) {
        throw InputError(place, fmt::format("the texture \"{}\" is not one of kind {}", name,
                                            kind == pbrt::TextureKind::real ? "float" : "spectrum"));
    }
    const auto known = by_name_.find({kind, name, use});
    if (known != by_name_.end()) {
        return known->second;
    }
    constexpr std::size_t deepest = 1000;
    if (std::find(open_.begin(), open_.end(), found->second) != open_.end()) {
        throw InputError(place, fmt::format("the texture \"{}\" is made of itself", name));
    }
    if (open_.size() >= deepest) {
        throw InputError(place, fmt::format("textures are made of each other more than {} deep", deepest));
    }
    open_.push_back(found->second);
    const Use outer = std::exchange(use_, use);
    const TextureId id = load(*found->second);
    use_ = outer;
    open_.pop_back();
    by_name_.emplace(std::tuple(kind, name, use), id);
    return id;
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
    if (texture.kind == pbrt::TextureKind::real) {
        return number_operand(texture, name, fallback);
    }
    const std::optional<TextureId> found = find_colour(texture.parameters, name, kind_of_colours());
    return found ? *found : textures_.add_constant(Rgb(fallback));
}

TextureId TextureLoader::number_operand(const pbrt::TextureEntity& texture, std::string_view name, float fallback) {
    return number(texture.parameters, name, fallback, use_ == Use::presence ? Use::presence : Use::number);
}

SpectrumKind TextureLoader::kind_of_colours() const {
    return use_ == Use::unbounded ? SpectrumKind::unbounded : SpectrumKind::reflectance;
}

std::optional<TextureId> TextureLoader::find_colour(const pbrt::ParameterSet& parameters, std::string_view name,
                                                    SpectrumKind kind) {
    const auto value = parameters.get_colour_or_texture(name);
    if (!value) {
        return std::nullopt;
    }
    const pbrt::Location& place = parameters.place_of(name);
    if (const auto* texture = std::get_if<pbrt::TextureName>(&*value)) {
        return named(texture->name, pbrt::TextureKind::spectrum, place,
                     kind == SpectrumKind::reflectance ? Use::surface : Use::unbounded);
    }
    return textures_.add_constant(reduce_colour(context_, std::get<pbrt::ColourValue>(*value), kind, place));
}

std::optional<TextureId> TextureLoader::find_real(const pbrt::ParameterSet& parameters, std::string_view name) {
    return parameters.has(name) ? std::optional(real(parameters, name, 0)) : std::nullopt;
}

std::optional<TextureId> TextureLoader::find_presence(const pbrt::ParameterSet& parameters, std::string_view name) {
    return parameters.has(name) ? std::optional(number(parameters, name, 0, Use::presence)) : std::nullopt;
}

TextureId TextureLoader::colour(const pbrt::ParameterSet& parameters, std::string_view name, const Rgb& fallback) {
    const std::optional<TextureId> found = find_colour(parameters, name, SpectrumKind::reflectance);
    return found ? *found : textures_.add_constant(fallback);
}

TextureId TextureLoader::real(const pbrt::ParameterSet& parameters, std::string_view name, float fallback) {
    return number(parameters, name, fallback, Use::number);
}

TextureId TextureLoader::number(const pbrt::ParameterSet& parameters, std::string_view name, float fallback, Use use) {
    const auto value = parameters.get_float_or_texture(name, fallback);
    if (const auto* texture = std::get_if<pbrt::TextureName>(&value)) {
        return named(texture->name, pbrt::TextureKind::real, parameters.place_of(name), use);
    }
    const float number = std::get<float>(value);
    if (!std::isfinite(number)) {
        throw InputError(parameters.place_of(name), fmt::format("\"{}\" must be finite", name));
    }
    return textures_.add_constant(Rgb(number));
}

TextureId TextureLoader::complement(TextureId number) {
    const Rgb* value = textures_.constant(number);
    return value ? constant(Rgb(1 - value->r))
                 : textures_.add(MixTexture{constant(Rgb(1.0f)), constant(Rgb(0.0f)), number});
}

TextureId TextureLoader::product(TextureId a, TextureId b) {
    const Rgb *first = textures_.constant(a), *second = textures_.constant(b);
    return first && second ? constant(Rgb(first->r * second->r)) : textures_.add(ScaleTexture{a, b});
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
            // What depends on the place instead varies over a cube around the origin.
            const Vec3 position(2 * uv.x - 1, 2 * uv.y - 1, static_cast<float>((x * 37 + y * 29) % side) / 32 - 1);
            const auto triangle = static_cast<std::uint32_t>(y * side + x);
            sum += textures_.evaluate(id, {uv, position, {0, 0, 1}, false, triangle, {1.0f / 3, 1.0f / 3}});
        }
    }
    return sum / static_cast<float>(side * side);
}

std::shared_ptr<const Image> TextureLoader::picture(const std::filesystem::path& file, const std::string& encoding,
                                                    const Place& place, Channels channels) {
    std::shared_ptr<const Image>& image = pictures_[{file.lexically_normal().string(), encoding, channels}];
    if (!image) {
        const std::tuple key(file.lexically_normal().string(), encoding, channels);
        image = read_part(context_, &LoadedParts::pictures, key, file, [&] {
            return std::make_shared<const Image>(read_channels(file, encoding, place, channels));
        });
    }
    return image;
}

}  // namespace wend
