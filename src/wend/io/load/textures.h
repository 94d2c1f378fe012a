#pragma once

#include <wend/io/load/context.h>
#include <wend/io/load/pictures.h>
#include <wend/io/spectrum/colorimetry.h>
#include <wend/scene/texture.h>

#include <initializer_list>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

namespace wend {

/// Adds the textures of a scene file to the scene's, and looks up what parameters refer to.
class TextureLoader {
public:
    /// Both must outlive this.
    TextureLoader(LoadContext& context, Textures& textures) : context_(context), textures_(textures) {}

    /// Adds all of them, which must outlive this: they may refer to each other in any order. Throws InputError for an
    /// unknown type, a missing or broken picture, a texture of the other kind or one that is made of itself.
    void add(const std::vector<pbrt::TextureEntity>& textures);

    /// The reflectance or number, or texture of such, that a parameter gives; a constant where it is absent.
    TextureId colour(const pbrt::ParameterSet& parameters, std::string_view name, const Rgb& fallback);
    TextureId real(const pbrt::ParameterSet& parameters, std::string_view name, float fallback);
    TextureId constant(const Rgb& value) { return textures_.add_constant(value); }
    /// None where the parameter is absent.
    std::optional<TextureId> find_colour(const pbrt::ParameterSet& parameters, std::string_view name,
                                         SpectrumKind kind);
    std::optional<TextureId> find_real(const pbrt::ParameterSet& parameters, std::string_view name);
    /// The same of a share of a surface that is there, for which pbrt filters no picture.
    std::optional<TextureId> find_presence(const pbrt::ParameterSet& parameters, std::string_view name);

    /// The albedo that colours a medium of the given one by a texture, over its own.
    TextureId relative_albedo(TextureId reflectance, std::shared_ptr<const AlbedoInversion> albedo_of,
                              const Rgb& albedo) {
        return textures_.add(RelativeAlbedoTexture{reflectance, std::move(albedo_of), albedo});
    }

    /// 1 less a number, and the product of two.
    TextureId complement(TextureId number);
    TextureId product(TextureId a, TextureId b);

    bool varies(TextureId id) const { return !textures_.constant(id); }
    /// The texture's value if it is constant; otherwise its mean over the unit square of (u, v).
    Rgb mean(TextureId id) const;

    using Channels = PictureChannels;

    /// Reads a picture file once however often it is asked for. `encoding` is pbrt's, of PNG files: "sRGB", "linear" or
    /// "gamma X"; or "raw", of any file, whose numbers are taken as they are. A number is in all three channels.
    std::shared_ptr<const Image> picture(const std::filesystem::path& file, const std::string& encoding,
                                         const Place& place, Channels channels = Channels::colours);

private:
    /// What a texture is asked for: pictures differ a little. Colours of surfaces are from 0 to 1, others not below 0;
    /// of a picture with several channels that is filtered finely, numbers are the first one, and presences are not.
    enum class Use { surface, unbounded, number, presence };

    TextureId load(const pbrt::TextureEntity& texture);
    TextureId load_constant(const pbrt::TextureEntity& texture);
    TextureId load_scale(const pbrt::TextureEntity& texture);
    TextureId load_mix(const pbrt::TextureEntity& texture);
    TextureId load_imagemap(const pbrt::TextureEntity& texture);
    TextureId load_checkerboard(const pbrt::TextureEntity& texture);
    TextureId load_sides(const pbrt::TextureEntity& texture);
    TextureId load_direction_mix(const pbrt::TextureEntity& texture);
    TextureId load_bilerp(const pbrt::TextureEntity& texture);
    TextureId load_dots(const pbrt::TextureEntity& texture);
    TextureId load_fractal(const pbrt::TextureEntity& texture);
    TextureId load_wrinkled(const pbrt::TextureEntity& texture);
    TextureId load_windy(const pbrt::TextureEntity& texture);
    TextureId load_marble(const pbrt::TextureEntity& texture);
    TextureId load_facing(const pbrt::TextureEntity& texture);
    TextureId load_mesh(const pbrt::TextureEntity& texture);
    TextureId load_ptex(const pbrt::TextureEntity& texture);

    /// Adds a texture made of others. Throws InputError if evaluating it takes absurdly many steps.
    TextureId add_node(Texture texture, std::initializer_list<TextureId> operands, const Place& place);
    /// A parameter of the texture's own kind.
    TextureId operand(const pbrt::TextureEntity& texture, std::string_view name, float fallback);
    TextureId number_operand(const pbrt::TextureEntity& texture, std::string_view name, float fallback);
    SpectrumKind kind_of_colours() const;
    TextureId named(const std::string& name, pbrt::TextureKind kind, const Place& place, Use use);
    TextureId number(const pbrt::ParameterSet& parameters, std::string_view name, float fallback, Use use);
    Channels load_channels(const pbrt::TextureEntity& texture, const std::string& filter) const;
    TextureMapping load_mapping(const pbrt::TextureEntity& texture);
    /// The numbers "values", three each of colours.
    std::shared_ptr<const std::vector<Rgb>> load_values(const pbrt::TextureEntity& texture) const;
    /// A value that cannot be a texture itself.
    Rgb plain_value(const pbrt::TextureEntity& texture, std::string_view name, float fallback);

    LoadContext& context_;
    Textures& textures_;
    std::map<std::pair<pbrt::TextureKind, std::string>, const pbrt::TextureEntity*> entities_;
    std::map<std::tuple<pbrt::TextureKind, std::string, Use>, TextureId> by_name_;
    std::vector<const pbrt::TextureEntity*> open_;  ///< that are being loaded, each for the sake of the next
    Use use_ = Use::number;                         ///< of the innermost
    std::map<std::tuple<std::string, std::string, Channels>, std::shared_ptr<const Image>> pictures_;
    std::map<TextureId, int> evaluations_;  ///< how many an evaluation takes, of textures made of others
};

}  // namespace wend
