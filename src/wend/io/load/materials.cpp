#include <wend/io/load/colours.h>
#include <wend/io/load/materials.h>
#include <wend/io/load/media.h>
#include <wend/io/spectrum/named_spectra.h>
#include <wend/medium/fresnel.h>
#include <wend/planar/albedo_inversion.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

class MaterialLoader {
public:
    MaterialLoader(LoadContext& context, TextureLoader& textures) : context_(context), textures_(textures) {}

    LoadedMaterial load(const pbrt::MaterialEntity& entity) {
        struct Stand {
            std::string_view type;
            std::string_view nearest;  ///< what a type that Wend does not have becomes; empty where it has it
            LoadedMaterial (MaterialLoader::*load)(const pbrt::MaterialEntity&);
        };
        static constexpr Stand known[] = {
            {"", "", &MaterialLoader::load_interface},
            {"none", "", &MaterialLoader::load_interface},
            {"interface", "", &MaterialLoader::load_interface},
            {"diffuse", "", &MaterialLoader::load_diffuse},
            {"coateddiffuse", "", &MaterialLoader::load_coated_diffuse},
            {"conductor", "", &MaterialLoader::load_conductor},
            {"dielectric", "", &MaterialLoader::load_dielectric},
            {"subsurface", "", &MaterialLoader::load_subsurface},
            {"coatedconductor", "conductor", &MaterialLoader::load_coated_conductor},
            {"diffusetransmission", "diffuse", &MaterialLoader::load_diffuse},
            {"hair", "diffuse", &MaterialLoader::load_diffuse},
            {"measured", "diffuse", &MaterialLoader::load_diffuse},
            {"thindielectric", "interface", &MaterialLoader::load_interface},
        };
        for (const Stand& stand : known) {
            if (stand.type != entity.type) {
                continue;
            }
            if (!stand.nearest.empty()) {
                context_.warnings.add(
                    entity.place, fmt::format("Material \"{}\" is not implemented: \"{}\" takes its place", stand.type,
                                              stand.nearest));
            }
            LoadedMaterial material = (this->*stand.load)(entity);
            context_.warnings.add_unused("Material", entity);
            return material;
        }
        refuse_type("Material", entity,
                    {"coatedconductor", "coateddiffuse", "conductor", "dielectric", "diffuse", "diffusetransmission",
                     "hair", "interface", "measured", "mix", "subsurface", "thindielectric"});
    }

private:
    LoadedMaterial load_interface(const pbrt::MaterialEntity&) { return {InterfaceMaterial{}, {}}; }

    LoadedMaterial load_diffuse(const pbrt::MaterialEntity& entity) {
        return {DiffuseMaterial{textures_.colour(entity.parameters, "reflectance", Rgb(0.5f))}, {}};
    }

    LoadedMaterial load_coated_diffuse(const pbrt::MaterialEntity& entity) {
        const pbrt::ParameterSet& p = entity.parameters;
        CoatedDiffuseMaterial material;
        material.reflectance = textures_.colour(p, "reflectance", Rgb(0.5f));
        material.ior = load_ior(p, 1.5f);
        material.roughness = load_roughness(p, "");
        material.inner_reflectance = fresnel_diffuse_reflectance(1 / material.ior);
        ignore_coat_medium(p);
        return {material, {}};
    }

    LoadedMaterial load_conductor(const pbrt::MaterialEntity& entity) {
        return {load_metal(entity.parameters, ""), {}};
    }

    LoadedMaterial load_coated_conductor(const pbrt::MaterialEntity& entity) {
        return {load_metal(entity.parameters, "conductor."), {}};
    }

    LoadedMaterial load_dielectric(const pbrt::MaterialEntity& entity) {
        return {DielectricMaterial{load_ior(entity.parameters, 1.5f), load_roughness(entity.parameters, "")}, {}};
    }

    LoadedMaterial load_subsurface(const pbrt::MaterialEntity& entity) {
        DielectricMaterial boundary{load_ior(entity.parameters, 1.33f), load_roughness(entity.parameters, "")};
        const HomogeneousMedium inside = load_inside(entity, boundary);
        return {boundary, inside};
    }

    /// pbrt's four ways to say what is inside: by name, by coefficients, by colour and mean free path, or not at all. A
    /// colour that varies goes to the boundary.
    HomogeneousMedium load_inside(const pbrt::MaterialEntity& entity, DielectricMaterial& boundary) {
        const pbrt::ParameterSet& p = entity.parameters;
        HomogeneousMedium medium;
        float g = load_mean_cosine(context_, p);
        const float scale = non_negative_float(p, "scale", 1);
        const auto absorption = textures_.find_colour(p, "sigma_a", SpectrumKind::unbounded);
        const auto scattering = textures_.find_colour(p, "sigma_s", SpectrumKind::unbounded);
        if (p.has("name")) {
            const MediumPreset measured = required_preset(p, "name");
            medium.absorption = measured.sigma_a * scale;
            medium.scattering = measured.sigma_prime_s * scale;
            g = 0;  // the tables hold reduced coefficients
        } else if (absorption || scattering) {
            if (!absorption || !scattering) {
                throw InputError(entity.place, "\"subsurface\" needs both \"sigma_a\" and \"sigma_s\", or neither");
            }
            medium.absorption = mean_of(p, "sigma_a", *absorption) * scale;
            medium.scattering = mean_of(p, "sigma_s", *scattering) * scale;
        } else if (const auto reflectance = textures_.find_colour(p, "reflectance", SpectrumKind::reflectance)) {
            const auto albedo_of = std::make_shared<AlbedoInversion>(g, boundary.ior);
            const Rgb colour = textures_.mean(*reflectance);
            const Rgb albedo((*albedo_of)(colour.r), (*albedo_of)(colour.g), (*albedo_of)(colour.b));
            const Rgb extinction = Rgb(1.0f) / load_mean_free_path(p, scale);
            medium.scattering = albedo * extinction;
            medium.absorption = (Rgb(1.0f) - albedo) * extinction;
            if (textures_.varies(*reflectance)) {
                boundary.relative_albedo = textures_.relative_albedo(*reflectance, albedo_of, albedo);
            }
        } else {
            medium.absorption = Rgb(0.0011f, 0.0024f, 0.014f) * scale;
            medium.scattering = Rgb(2.55f, 3.21f, 3.77f) * scale;
        }
        medium.phase = PhaseFunction(HenyeyGreenstein{g});
        medium.counts_vertices = false;
        return medium;
    }

    Rgb load_mean_free_path(const pbrt::ParameterSet& p, float scale) {
        const auto given = textures_.find_colour(p, "mfp", SpectrumKind::unbounded);
        const Rgb mean_free_path = (given ? mean_of(p, "mfp", *given) : Rgb(1.0f)) * scale;
        for (int c = 0; c < 3; ++c) {
            if (!(mean_free_path[c] > 0)) {
                throw InputError(p.place_of("mfp"), "the mean free path must be above 0");
            }
        }
        return mean_free_path;
    }

    Rgb mean_of(const pbrt::ParameterSet& p, std::string_view name, TextureId texture) {
        if (textures_.varies(texture)) {
            context_.warnings.add(
                p.place_of(name),
                fmt::format("only the \"reflectance\" of what is inside an object can vary: the mean of the texture "
                            "\"{}\" is taken",
                            name));
        }
        return textures_.mean(texture);
    }

    ConductorMaterial load_metal(const pbrt::ParameterSet& p, const std::string& prefix) {
        ConductorMaterial material;
        material.roughness = load_roughness(p, prefix);
        if (const auto found = textures_.find_colour(p, "reflectance", SpectrumKind::reflectance)) {
            if (p.has(prefix + "eta") || p.has(prefix + "k")) {
                throw InputError(p.place_of("reflectance"),
                                 "a conductor takes either \"reflectance\" or \"eta\" and \"k\"");
            }
            material.reflectance = *found;
            return material;
        }
        material.eta = textures_.find_colour(p, prefix + "eta", SpectrumKind::unbounded).value_or(-1);
        material.k = textures_.find_colour(p, prefix + "k", SpectrumKind::unbounded).value_or(-1);
        if (material.eta < 0) {
            material.eta = copper("metal-Cu-eta");
        }
        if (material.k < 0) {
            material.k = copper("metal-Cu-k");
        }
        return material;
    }

    TextureId copper(const char* name) { return textures_.constant(named_spectrum(name)); }

    Roughness load_roughness(const pbrt::ParameterSet& p, const std::string& prefix) {
        const TextureId both = textures_.real(p, prefix + "roughness", 0);
        return {textures_.find_real(p, prefix + "uroughness").value_or(both),
                textures_.find_real(p, prefix + "vroughness").value_or(both), p.get_bool("remaproughness", true)};
    }

    /// A number or a spectrum: a glass at the d line, of others the mean. There is no dispersion.
    float load_ior(const pbrt::ParameterSet& p, float fallback) {
        float ior = fallback;
        if (const auto type = p.type_of("eta"); !type || *type == pbrt::ParameterType::real) {
            ior = p.get_float("eta", fallback);
        } else {
            const pbrt::ColourValue value = p.get_colour("eta").value();
            const auto* named = std::get_if<pbrt::NamedSpectrum>(&value);
            const auto glass = named ? glass_index(named->name) : std::nullopt;
            ior = glass ? *glass : mean(reduce_colour(context_, value, SpectrumKind::unbounded, p.place_of("eta")));
        }
        if (!(ior > 0) || !std::isfinite(ior)) {
            throw InputError(p.place_of("eta"), fmt::format("a refractive index must be above 0, not {}", ior));
        }
        return ior;
    }

    void ignore_coat_medium(const pbrt::ParameterSet& p) {
        // Without scattering inside, the coat's thickness has no effect, and it is not sampled at random here.
        static_cast<void>(textures_.real(p, "thickness", 0.01f));
        static_cast<void>(textures_.real(p, "g", 0));
        static_cast<void>(p.get_int("maxdepth", 0));
        static_cast<void>(p.get_int("nsamples", 0));
        if (const auto albedo = textures_.find_colour(p, "albedo", SpectrumKind::reflectance);
            albedo && !is_black(textures_.mean(*albedo))) {
            context_.warnings.add(p.place_of("albedo"),
                                  "the coat of \"coateddiffuse\" does not scatter: \"albedo\" is ignored");
        }
    }

    LoadContext& context_;
    TextureLoader& textures_;
};

/// What stands for a mixture: the first of its materials that is none.
const pbrt::MaterialEntity& unmixed(LoadContext& context, const std::vector<pbrt::MaterialEntity>& materials,
                                    const pbrt::MaterialEntity& entity) {
    const pbrt::MaterialEntity* current = &entity;
    for (std::size_t step = 0; current->type == "mix"; ++step) {
        const pbrt::ParameterSet& p = current->parameters;
        const std::vector<std::string> names = p.get_strings("materials");
        static_cast<void>(p.get_float_or_texture("amount", 0.5f));
        context.warnings.add(current->place, "Material \"mix\" is not implemented: its first material takes its place");
        context.warnings.add_unused("Material", *current);
        if (names.size() != 2) {
            throw InputError(p.place_of("materials"), "\"mix\" needs the names of two \"materials\"");
        }
        const auto found =
            std::find_if(materials.begin(), materials.end(), [&](const auto& m) { return m.name == names[0]; });
        if (found == materials.end() || names[0].empty()) {
            throw InputError(p.place_of("materials"), fmt::format("the material \"{}\" is not defined", names[0]));
        }
        if (step > materials.size()) {
            throw InputError(p.place_of("materials"), "\"mix\" is made of itself");
        }
        current = &*found;
    }
    return *current;
}

}  // namespace

std::vector<LoadedMaterial> load_materials(LoadContext& context, TextureLoader& textures,
                                           const std::vector<pbrt::MaterialEntity>& materials) {
    MaterialLoader loader(context, textures);
    std::vector<LoadedMaterial> loaded;
    loaded.reserve(materials.size());
    for (const pbrt::MaterialEntity& material : materials) {
        loaded.push_back(loader.load(unmixed(context, materials, material)));
    }
    return loaded;
}

}  // namespace wend
