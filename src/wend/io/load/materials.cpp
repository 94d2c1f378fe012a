#include <wend/io/load/materials.h>

#include <wend/io/load/artists_materials.h>
#include <wend/io/load/colours.h>
#include <wend/io/load/measured.h>
#include <wend/io/load/media.h>
#include <wend/io/load/mixtures.h>
#include <wend/io/load/subsurface_media.h>
#include <wend/io/spectrum/metal.h>
#include <wend/io/spectrum/named_spectra.h>
#include <wend/medium/fresnel.h>
#include <wend/scene/bsdf/rough_coat.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <utility>

namespace wend {
namespace {

class MaterialLoader {
public:
    MaterialLoader(LoadContext& context, TextureLoader& textures, const std::vector<pbrt::MaterialEntity>& all)
        : context_(context), textures_(textures), all_(all) {}

    LoadedMaterial load(const pbrt::MaterialEntity& entity) {
        using Loader = LoadedMaterial (MaterialLoader::*)(const pbrt::MaterialEntity&);
        static constexpr std::pair<std::string_view, Loader> known[] = {
            {"", &MaterialLoader::load_interface},
            {"none", &MaterialLoader::load_interface},
            {"interface", &MaterialLoader::load_interface},
            {"diffuse", &MaterialLoader::load_diffuse},
            {"diffusetransmission", &MaterialLoader::load_diffuse_transmission},
            {"coateddiffuse", &MaterialLoader::load_coated_diffuse},
            {"coatedconductor", &MaterialLoader::load_coated_conductor},
            {"conductor", &MaterialLoader::load_conductor},
            {"dielectric", &MaterialLoader::load_dielectric},
            {"thindielectric", &MaterialLoader::load_thin_dielectric},
            {"subsurface", &MaterialLoader::load_subsurface},
            {"hair", &MaterialLoader::load_hair},
            {"mix", &MaterialLoader::load_mix},
            {"sum", &MaterialLoader::load_mix},
            {"burley", &MaterialLoader::load_disney},
            {"burleysheet", &MaterialLoader::load_disney_sheet},
            {"principled", &MaterialLoader::load_principled},
            {"measured", &MaterialLoader::load_measured},
        };
        for (const auto& [type, loader] : known) {
            if (type != entity.type) {
                continue;
            }
            LoadedMaterial material = (this->*loader)(entity);
            material.detail = load_detail(entity);
            context_.warnings.add_unused("Material", entity);
            return material;
        }
        refuse_type("Material", entity,
                    {"burley", "burleysheet", "coatedconductor", "coateddiffuse", "conductor", "dielectric", "diffuse",
                     "diffusetransmission", "hair", "interface", "measured", "mix", "principled", "subsurface", "sum",
                     "thindielectric"});
    }

private:
    LoadedMaterial load_interface(const pbrt::MaterialEntity&) { return {InterfaceMaterial{}}; }

    LoadedMaterial load_diffuse(const pbrt::MaterialEntity& entity) {
        return {DiffuseMaterial{textures_.colour(entity.parameters, "reflectance", Rgb(0.5f))}};
    }

    LoadedMaterial load_measured(const pbrt::MaterialEntity& entity) {
        const std::filesystem::path file = required_file(context_, entity, "filename");
        std::shared_ptr<const MeasuredTables>& tables = measured_[file];
        return {MeasuredMaterial{tables ? tables : tables = read_measured(file)}};
    }

    LoadedMaterial load_diffuse_transmission(const pbrt::MaterialEntity& entity) {
        const pbrt::ParameterSet& p = entity.parameters;
        return {DiffuseTransmissionMaterial{textures_.colour(p, "reflectance", Rgb(0.25f)),
                                            textures_.colour(p, "transmittance", Rgb(0.25f)),
                                            non_negative_float(p, "scale", 1)}};
    }

    /// What multiplies what Fresnel's equations say; -1: nothing.
    TextureId load_factor(const pbrt::MaterialEntity& entity, const char* name) {
        return textures_.find_colour(entity.parameters, name, SpectrumKind::reflectance).value_or(-1);
    }

    LoadedMaterial load_thin_dielectric(const pbrt::MaterialEntity& entity) {
        return {ThinDielectricMaterial{load_ior(entity.parameters, "eta", 1.5f), load_factor(entity, "reflectance"),
                                       load_factor(entity, "transmittance")}};
    }

    LoadedMaterial load_coated_diffuse(const pbrt::MaterialEntity& entity) {
        const pbrt::ParameterSet& p = entity.parameters;
        CoatedMaterial material = load_coat(p, "");
        material.base = DiffuseMaterial{textures_.colour(p, "reflectance", Rgb(0.5f))};
        material.is_linear = p.get_bool("linear", false);
        return {material};
    }

    LoadedMaterial load_coated_conductor(const pbrt::MaterialEntity& entity) {
        CoatedMaterial material = load_coat(entity.parameters, "interface.");
        material.base = load_metal(entity.parameters, "conductor.", material.ior);
        return {material};
    }

    CoatedMaterial load_coat(const pbrt::ParameterSet& p, const std::string& prefix) {
        CoatedMaterial material;
        material.ior = load_ior(p, prefix + "eta", 1.5f);
        material.roughness = load_roughness(p, prefix);
        material.thickness = textures_.real(p, "thickness", 0.01f);
        material.albedo = textures_.colour(p, "albedo", Rgb(0.0f));
        material.mean_cosine = textures_.real(p, "g", 0);
        material.max_depth = load_count(p, "maxdepth", 10);
        material.walks = load_count(p, "nsamples", 1);
        if (const Roughness& r = material.roughness; !textures_.varies(material.thickness)) {
            // A roughness that varies counts as none.
            const bool varies = textures_.varies(r.u) || textures_.varies(r.v);
            const auto alpha = [&](TextureId id) {
                const float value = varies ? 0.0f : std::max(textures_.mean(id).r, 0.0f);
                return r.remap ? std::sqrt(value) : value;
            };
            const DielectricBsdf coat{
                .ior = material.ior, .alpha_x = alpha(r.u), .alpha_y = alpha(r.v), .slopes = r.slopes};
            material.returned = rough_coat_return(coat, std::max(textures_.mean(material.thickness).r, 0.0f));
        }
        return material;
    }

    /// Of walks and of their steps, each of which costs time for every value.
    int load_count(const pbrt::ParameterSet& p, std::string_view name, int fallback) {
        constexpr int most = 1000;
        const int count = p.get_int(name, fallback);
        if (count < 1 || count > most) {
            throw InputError(p.place_of(name), fmt::format("\"{}\" must be from 1 to {}, not {}", name, most, count));
        }
        return count;
    }

    LoadedMaterial load_hair(const pbrt::MaterialEntity& entity) {
        const pbrt::ParameterSet& p = entity.parameters;
        HairMaterial hair;
        const auto colour = [&](const char* name, SpectrumKind kind, HairMaterial::Colour given) {
            const auto found = textures_.find_colour(p, name, kind);
            if (found && hair.colour >= 0) {
                context_.warnings.add(p.place_of(name), fmt::format("\"{}\" of a hair is ignored: its colour is given "
                                                                    "otherwise",
                                                                    name));
            } else if (found) {
                hair.colour = *found;
                hair.given = given;
            }
        };
        colour("sigma_a", SpectrumKind::unbounded, HairMaterial::Colour::absorption);
        colour("reflectance", SpectrumKind::reflectance, HairMaterial::Colour::reflectance);
        colour("color", SpectrumKind::reflectance, HairMaterial::Colour::reflectance);
        hair.eumelanin = textures_.find_real(p, "eumelanin").value_or(-1);
        hair.pheomelanin = textures_.find_real(p, "pheomelanin").value_or(-1);
        if (hair.colour < 0 && hair.eumelanin < 0 && hair.pheomelanin < 0) {
            hair.eumelanin = textures_.constant(Rgb(1.3f));
        }
        hair.ior = textures_.real(p, "eta", 1.55f);
        if (!textures_.varies(hair.ior) && !(textures_.mean(hair.ior).r > 1)) {
            throw InputError(p.place_of("eta"), "the index of a hair must be above 1");
        }
        hair.roughness_along = textures_.real(p, "beta_m", 0.3f);
        hair.roughness_across = textures_.real(p, "beta_n", 0.3f);
        hair.tilt = textures_.real(p, "alpha", 2);
        return {hair};
    }

    /// Not one of pbrt's: what Blender, USD and MaterialX have.
    LoadedMaterial load_principled(const pbrt::MaterialEntity& entity) {
        const pbrt::ParameterSet& p = entity.parameters;
        PrincipledMaterial material = principled_surface(textures_, p);
        material.ior = load_ior(p, "eta", 1.5f);
        material.coat_ior = load_ior(p, "coateta", 1.5f);
        material.below = facets_of(material.ior);
        material.above = facets_of(material.coat_ior);
        const auto subsurface = textures_.find_real(p, "subsurface");
        return subsurface ? load_principled_inside(p, material, *subsurface) : LoadedMaterial{material};
    }

    /// What Mitsuba's scenes have.
    LoadedMaterial load_disney(const pbrt::MaterialEntity& entity) {
        DisneyMaterial material = disney_surface(textures_, entity.parameters);
        material.ior = load_ior(entity.parameters, "eta", 1.5f);
        return {material};
    }

    LoadedMaterial load_disney_sheet(const pbrt::MaterialEntity& entity) {
        DisneySheetMaterial material = disney_sheet(textures_, entity.parameters);
        material.ior = load_ior(entity.parameters, "eta", 1.5f);
        return {material};
    }

    /// An albedo that varies goes to where walks enter.
    LoadedMaterial load_principled_inside(const pbrt::ParameterSet& p, PrincipledMaterial& material,
                                          TextureId subsurface) {
        material.subsurface = subsurface;
        material.entry_ior = load_ior(p, "subsurfaceeta", material.ior);
        material.entry_roughness = textures_.find_real(p, "subsurfaceroughness").value_or(material.roughness);
        material.entry_even = p.get_float("subsurfaceeven", 0);
        if (!(material.entry_even >= 0 && material.entry_even <= 1)) {
            throw InputError(p.place_of("subsurfaceeven"), "\"subsurfaceeven\" must be from 0 to 1");
        }
        const TextureId albedo = textures_.colour(p, "subsurfacealbedo", Rgb(0.9f));
        Rgb inside = textures_.mean(albedo);
        if (textures_.varies(albedo)) {
            material.relative_albedo = albedo;
            inside = Rgb(1.0f);
        }
        const Rgb extinction =
            Rgb(1.0f) / load_mean_free_path(context_, textures_, p, non_negative_float(p, "scale", 1));
        HomogeneousMedium medium;
        medium.scattering = inside * extinction;
        medium.absorption = (Rgb(1.0f) - inside) * extinction;
        medium.phase = PhaseFunction(HenyeyGreenstein{load_mean_cosine(context_, p)});
        medium.counts_vertices = false;
        return {material, medium};
    }

    std::shared_ptr<const FacetAlbedo> facets_of(float ior) {
        std::shared_ptr<const FacetAlbedo>& facets = facets_[ior];
        return facets ? facets : facets = std::make_shared<const FacetAlbedo>(ior);
    }

    LoadedMaterial load_mix(const pbrt::MaterialEntity& entity) {
        const pbrt::ParameterSet& p = entity.parameters;
        const std::vector<std::string> names = p.get_strings("materials");
        if (names.size() != 2) {
            throw InputError(p.place_of("materials"),
                             fmt::format("\"{}\" needs the names of two \"materials\"", entity.type));
        }
        return {MixMaterial{index_of(names[0], p), index_of(names[1], p), textures_.real(p, "amount", 0.5f),
                            entity.type == "sum"}};
    }

    int index_of(const std::string& name, const pbrt::ParameterSet& p) const {
        const auto found = std::find_if(all_.begin(), all_.end(), [&](const auto& m) { return m.name == name; });
        if (found == all_.end() || name.empty()) {
            throw InputError(p.place_of("materials"), fmt::format("the material \"{}\" is not defined", name));
        }
        return static_cast<int>(found - all_.begin());
    }

    SurfaceDetail load_detail(const pbrt::MaterialEntity& entity) {
        const pbrt::ParameterSet& p = entity.parameters;
        SurfaceDetail detail;
        const auto displacement = textures_.find_real(p, "displacement");
        if (!p.get_string("normalmap", "").empty()) {
            if (displacement) {
                context_.warnings.add(p.place_of("displacement"), "\"displacement\" is ignored beside \"normalmap\"");
            }
            detail.normal_map = textures_.picture(required_file(context_, entity, "normalmap"),
                                                  is_from_top(p, "normalmaporigin") ? "raw" : "linear", entity.place);
            if (is_from_top(p, "normalmaporigin")) {
                detail.normal_map = std::make_shared<const Image>(upside_down(*detail.normal_map));
            }
        } else if (displacement && textures_.varies(*displacement)) {
            detail.displacement = *displacement;
        }
        return detail;
    }

    LoadedMaterial load_conductor(const pbrt::MaterialEntity& entity) { return {load_metal(entity.parameters, "", 1)}; }

    LoadedMaterial load_dielectric(const pbrt::MaterialEntity& entity) {
        DielectricMaterial material{load_ior(entity.parameters, "eta", 1.5f), load_roughness(entity.parameters, "")};
        material.reflectance = load_factor(entity, "reflectance");
        material.transmittance = load_factor(entity, "transmittance");
        material.is_antireflective = entity.parameters.get_bool("antireflective", false);
        return {material};
    }

    LoadedMaterial load_subsurface(const pbrt::MaterialEntity& entity) {
        DielectricMaterial boundary{load_ior(entity.parameters, "eta", 1.33f), load_roughness(entity.parameters, "")};
        const HomogeneousMedium inside = load_inside(context_, textures_, entity, boundary);
        if (context_.is_for_pbrt) {
            context_.warnings.add(entity.place,
                                  "the inside of a \"subsurface\" is walked through: the diffusion that pbrt takes for "
                                  "it is up to 10 % off on a plane, and more where an object is thin");
        }
        return {boundary, inside};
    }

    /// `around`: index of what is before the metal.
    ConductorMaterial load_metal(const pbrt::ParameterSet& p, const std::string& prefix, float around) {
        ConductorMaterial material;
        material.roughness = load_roughness(p, prefix);
        material.tint = textures_.find_colour(p, prefix + "tint", SpectrumKind::reflectance).value_or(-1);
        if (const auto found = textures_.find_colour(p, "reflectance", SpectrumKind::reflectance)) {
            if (p.has(prefix + "eta") || p.has(prefix + "k")) {
                throw InputError(p.place_of("reflectance"),
                                 "a conductor takes either \"reflectance\" or \"eta\" and \"k\"");
            }
            material.reflectance = *found;
            return material;
        }
        // Copper where nothing is given. What is known by wavelength is averaged by what it reflects.
        const auto by_wavelength = [&](const std::string& name, const char* copper) {
            return p.has(name)
                       ? (p.type_of(name) == pbrt::ParameterType::spectrum ? find_spectrum(context_, p, name) : nullptr)
                       : find_metal_constant(copper);
        };
        const auto eta = by_wavelength(prefix + "eta", "metal-Cu-eta"), k = by_wavelength(prefix + "k", "metal-Cu-k");
        if (eta && k) {
            const MetalConstants constants = reduce_metal(eta, k, around);
            require_countable(p, prefix + "eta", constants.eta);
            require_countable(p, prefix + "k", constants.k);
            material.eta = textures_.constant(constants.eta);
            material.k = textures_.constant(constants.k);
            return material;
        }
        const auto constant = [&](const std::string& name, const char* copper) {
            const auto found = textures_.find_colour(p, name, SpectrumKind::unbounded);
            if (found && !textures_.varies(*found)) {
                require_countable(p, name, textures_.mean(*found));
            }
            return found ? *found : textures_.constant(named_spectrum(copper));
        };
        material.eta = constant(prefix + "eta", "metal-Cu-eta");
        material.k = constant(prefix + "k", "metal-Cu-k");
        return material;
    }

    /// Throws InputError where Fresnel's equations would leave the range of floats.
    static void require_countable(const pbrt::ParameterSet& p, const std::string& name, const Rgb& value) {
        constexpr float largest = 1e6f;
        if (!is_finite(value) || !(max_value(value) <= largest)) {
            throw InputError(p.place_of(name),
                             fmt::format("\"{}\" of a metal must not be above {:g}, but is ({}, {}, {})", name, largest,
                                         value.r, value.g, value.b));
        }
    }

    Roughness load_roughness(const pbrt::ParameterSet& p, const std::string& prefix) {
        const TextureId both = textures_.real(p, prefix + "roughness", 0);
        return {textures_.find_real(p, prefix + "uroughness").value_or(both),
                textures_.find_real(p, prefix + "vroughness").value_or(both), p.get_bool("remaproughness", true),
                load_slopes(p)};
    }

    /// "facets", beyond pbrt.
    static FacetSlopes load_slopes(const pbrt::ParameterSet& p) {
        const std::string name = p.get_string("facets", "ggx");
        if (name != "ggx" && name != "beckmann") {
            throw InputError(p.place_of("facets"),
                             fmt::format("the facets \"{}\" are unknown; known are ggx, beckmann", name));
        }
        return name == "ggx" ? FacetSlopes::ggx : FacetSlopes::beckmann;
    }

    /// A number or a spectrum: a glass at the d line, of others the mean. There is no dispersion.
    float load_ior(const pbrt::ParameterSet& p, const std::string& name, float fallback) {
        float ior = fallback;
        if (const auto type = p.type_of(name); !type || *type == pbrt::ParameterType::real) {
            ior = p.get_float(name, fallback);
        } else {
            const pbrt::ColourValue value = p.get_colour(name).value();
            const auto* named = std::get_if<pbrt::NamedSpectrum>(&value);
            const auto glass = named ? glass_index(named->name) : std::nullopt;
            ior = glass ? *glass : mean(reduce_colour(context_, value, SpectrumKind::unbounded, p.place_of(name)));
        }
        if (ior == 0) {
            context_.warnings.add(p.place_of(name), "a refractive index of 0 is taken for 1, as in pbrt");
            return 1;
        }
        if (!(ior > 0) || !std::isfinite(ior)) {
            throw InputError(p.place_of(name), fmt::format("a refractive index must be above 0, not {}", ior));
        }
        return ior;
    }

    LoadContext& context_;
    TextureLoader& textures_;
    const std::vector<pbrt::MaterialEntity>& all_;
    std::map<float, std::shared_ptr<const FacetAlbedo>> facets_;  // by index
    std::map<std::filesystem::path, std::shared_ptr<const MeasuredTables>> measured_;
};

}  // namespace

std::vector<LoadedMaterial> load_materials(LoadContext& context, TextureLoader& textures,
                                           const std::vector<pbrt::MaterialEntity>& materials) {
    MaterialLoader loader(context, textures, materials);
    std::vector<LoadedMaterial> loaded;
    loaded.reserve(materials.size());
    for (const pbrt::MaterialEntity& material : materials) {
        loaded.push_back(loader.load(material));
    }
    check_mixtures(context, textures, loaded, materials);
    return loaded;
}

}  // namespace wend
