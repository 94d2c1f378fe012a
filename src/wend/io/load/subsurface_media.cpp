#include <wend/io/load/subsurface_media.h>

#include <wend/io/load/colours.h>
#include <wend/io/load/media.h>
#include <wend/planar/albedo_inversion.h>

#include <fmt/format.h>

#include <memory>
#include <string_view>

namespace wend {
namespace {

Rgb mean_of(LoadContext& context, TextureLoader& textures, const pbrt::ParameterSet& p, std::string_view name,
            TextureId texture) {
    if (textures.varies(texture)) {
        context.warnings.add(
            p.place_of(name),
            fmt::format("only the \"reflectance\" of what is inside an object can vary: the mean of the texture "
                        "\"{}\" is taken",
                        name));
    }
    return textures.mean(texture);
}

}  // namespace

HomogeneousMedium load_inside(LoadContext& context, TextureLoader& textures, const pbrt::MaterialEntity& entity,
                              DielectricMaterial& boundary) {
    const pbrt::ParameterSet& p = entity.parameters;
    HomogeneousMedium medium;
    float g = load_mean_cosine(context, p);
    const float scale = non_negative_float(p, "scale", 1);
    const auto absorption = textures.find_colour(p, "sigma_a", SpectrumKind::unbounded);
    const auto scattering = textures.find_colour(p, "sigma_s", SpectrumKind::unbounded);
    if (p.has("name")) {
        const MediumPreset measured = required_preset(p, "name");
        medium.absorption = measured.sigma_a * scale;
        medium.scattering = measured.sigma_prime_s * scale;
        g = 0;  // the tables hold reduced coefficients
    } else if (absorption || scattering) {
        if (!absorption || !scattering) {
            throw InputError(entity.place, "\"subsurface\" needs both \"sigma_a\" and \"sigma_s\", or neither");
        }
        medium.absorption = mean_of(context, textures, p, "sigma_a", *absorption) * scale;
        medium.scattering = mean_of(context, textures, p, "sigma_s", *scattering) * scale;
    } else if (const auto reflectance = textures.find_colour(p, "reflectance", SpectrumKind::reflectance)) {
        const auto albedo_of = std::make_shared<AlbedoInversion>(g, boundary.ior);
        const Rgb colour = textures.mean(*reflectance);
        const Rgb albedo((*albedo_of)(colour.r), (*albedo_of)(colour.g), (*albedo_of)(colour.b));
        const Rgb extinction = Rgb(1.0f) / load_mean_free_path(context, textures, p, scale);
        medium.scattering = albedo * extinction;
        medium.absorption = (Rgb(1.0f) - albedo) * extinction;
        if (textures.varies(*reflectance)) {
            boundary.relative_albedo = textures.relative_albedo(*reflectance, albedo_of, albedo);
        }
    } else {
        medium.absorption = Rgb(0.0011f, 0.0024f, 0.014f) * scale;
        medium.scattering = Rgb(2.55f, 3.21f, 3.77f) * scale;
    }
    medium.phase = PhaseFunction(HenyeyGreenstein{g});
    medium.counts_vertices = false;
    return medium;
}

Rgb load_mean_free_path(LoadContext& context, TextureLoader& textures, const pbrt::ParameterSet& p, float scale) {
    const auto given = textures.find_colour(p, "mfp", SpectrumKind::unbounded);
    const Rgb mean_free_path = (given ? mean_of(context, textures, p, "mfp", *given) : Rgb(1.0f)) * scale;
    for (int c = 0; c < 3; ++c) {
        if (!(mean_free_path[c] > 0)) {
            throw InputError(p.place_of("mfp"), "the mean free path must be above 0");
        }
    }
    return mean_free_path;
}

}  // namespace wend
