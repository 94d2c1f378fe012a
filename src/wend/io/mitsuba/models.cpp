#include <wend/io/mitsuba/models.h>

#include <wend/core/error.h>
#include <wend/io/mitsuba/indices.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <initializer_list>
#include <string_view>
#include <utility>

namespace wend::mitsuba {
namespace {

constexpr std::string_view known_types =
    "blendbsdf, bumpmap, circular, conductor, dielectric, diffuse, hair, mask, measured, normalmap, null, plastic, "
    "polarizer, principled, principledthin, retarder, roughconductor, roughdielectric, roughplastic, thindielectric, "
    "twosided";

}  // namespace

Model Models::of(const Object& bsdf) {
    const std::string_view type = bsdf.type();
    if (type == "diffuse") {
        return diffuse(bsdf);
    }
    if (bsdf.is_one_of({"dielectric", "roughdielectric", "thindielectric"})) {
        return dielectric(bsdf);
    }
    if (bsdf.is_one_of({"conductor", "roughconductor"})) {
        return conductor(bsdf);
    }
    if (bsdf.is_one_of({"plastic", "roughplastic", "pplastic"})) {
        return plastic(bsdf);
    }
    if (type == "principled") {
        return principled(bsdf);
    }
    if (type == "hair") {
        return hair(bsdf);
    }
    if (type == "principledthin") {
        return thin(bsdf);
    }
    if (type == "measured") {
        return measured(bsdf);
    }
    if (type == "null") {
        return {"interface", Parameters(bsdf.place()), false};
    }
    return replaced(bsdf);
}

Model Models::diffuse(const Object& bsdf) {
    Parameters p(bsdf.place());
    p.colour("reflectance", textures_.colour(bsdf, "reflectance", Rgb(0.5f)));
    return {"diffuse", std::move(p)};
}

/// Colours that make nature's laws others.
void Models::require_one(const Object& bsdf, std::string_view name) {
    if (const Element* given = bsdf.find(name)) {
        if (is_texture(*given) || colour_of(context_, *given, SpectrumUse::unbounded) != Rgb(1.0f)) {
            context_.warn(given->place, fmt::format("\"{}\" of {} is ignored: it is 1", name, bsdf.title()));
        }
    }
}

void Models::set_roughness(const Object& bsdf, const std::string& prefix, Parameters& p) {
    const std::string facets = bsdf.text("distribution", "beckmann");
    if (facets != "beckmann" && facets != "ggx") {
        throw InputError(bsdf.place_of("distribution"),
                         fmt::format("\"{}\" is no distribution of facets; known are beckmann, ggx", facets));
    }
    bsdf.ignore("sample_visible");
    p.flag("remaproughness", false).text("facets", facets);
    if (bsdf.has("alpha_u") || bsdf.has("alpha_v")) {
        p.real(prefix + "uroughness", textures_.number(bsdf, "alpha_u", 0.1))
            .real(prefix + "vroughness", textures_.number(bsdf, "alpha_v", 0.1));
    } else {
        p.real(prefix + "roughness", textures_.number(bsdf, "alpha", 0.1));
    }
}

Model Models::dielectric(const Object& bsdf) {
    Parameters p(bsdf.place());
    p.real("eta", index_of(bsdf, "int_ior", "bk7") / index_of(bsdf, "ext_ior", "air"));
    for (const auto& [name, parameter] :
         {std::pair{"specular_reflectance", "reflectance"}, std::pair{"specular_transmittance", "transmittance"}}) {
        if (bsdf.has(name)) {
            p.colour(parameter, textures_.colour(bsdf, name, Rgb(1.0f)));
        }
    }
    if (bsdf.type() == "thindielectric") {
        return {"thindielectric", std::move(p), false};
    }
    if (bsdf.type() == "roughdielectric") {
        set_roughness(bsdf, "", p);
    }
    return {"dielectric", std::move(p), false};
}

Model Models::conductor(const Object& bsdf) {
    Parameters p(bsdf.place());
    if (bsdf.has("specular_reflectance")) {
        p.colour("tint", textures_.colour(bsdf, "specular_reflectance", Rgb(1.0f)));
    }
    if (bsdf.has("eta") || bsdf.has("k")) {
        if (bsdf.has("material")) {
            throw InputError(bsdf.place_of("material"), "a conductor takes either a \"material\" or \"eta\" and \"k\"");
        }
        p.colour("eta", colour_of(bsdf, "eta", SpectrumUse::unbounded, Rgb(0.0f)))
            .colour("k", colour_of(bsdf, "k", SpectrumUse::unbounded, Rgb(1.0f)));
    } else {
        const MetalIndex metal = metal_index(bsdf.text("material", "none"), bsdf.place_of("material"));
        p.colour("eta", metal.eta).colour("k", metal.k);
    }
    if (bsdf.type() == "roughconductor") {
        set_roughness(bsdf, "", p);
    }
    return {"conductor", std::move(p)};
}

Model Models::plastic(const Object& bsdf) {
    Parameters p(bsdf.place());
    p.real("eta", index_of(bsdf, "int_ior", "polypropylene") / index_of(bsdf, "ext_ior", "air"));
    require_one(bsdf, "specular_reflectance");
    p.colour("reflectance", textures_.colour(bsdf, "diffuse_reflectance", Rgb(0.5f)))
        .real("thickness", 0)
        .integer("maxdepth", 100)
        .flag("linear", !bsdf.flag("nonlinear", false));
    if (bsdf.type() == "plastic") {
        p.real("roughness", 0);
    } else {
        set_roughness(bsdf, "", p);
    }
    return {"coateddiffuse", std::move(p)};
}

Model Models::principled(const Object& bsdf) {
    Parameters p(bsdf.place());
    p.colour("reflectance", textures_.colour(bsdf, "base_color", Rgb(0.5f)))
        .real("roughness", textures_.number(bsdf, "roughness", 0.5));
    for (const auto& [name, parameter] :
         {std::pair{"anisotropic", "anisotropy"}, std::pair{"metallic", "metallic"},
          std::pair{"spec_trans", "transmission"}, std::pair{"spec_tint", "speculartint"}, std::pair{"sheen", "sheen"},
          std::pair{"sheen_tint", "sheentint"}, std::pair{"flatness", "flatness"}, std::pair{"clearcoat", "coat"},
          std::pair{"clearcoat_gloss", "coatgloss"}}) {
        if (bsdf.has(name)) {
            p.real(parameter, textures_.number(bsdf, name, 0));
        }
    }
    if (bsdf.has("eta") && bsdf.has("specular")) {
        throw InputError(bsdf.place_of("specular"), "a principled surface takes either \"eta\" or \"specular\"");
    }
    const bool transmits = bsdf.has("spec_trans");
    double index = 0;
    if (bsdf.has("eta")) {
        index = bsdf.positive("eta", 1.5);
        index = transmits && index == 1 ? 1.001 : index;
    } else {
        // The reflectance at normal incidence is 0.08 times "specular".
        const double specular = bsdf.non_negative("specular", 0.5);
        index = 2 / (1 - std::sqrt(0.08 * std::clamp(specular, transmits ? 1e-3 : 0.0, 12.0))) - 1;
    }
    p.real("eta", index);
    for (const char* name :
         {"main_specular_sampling_rate", "clearcoat_sampling_rate", "diffuse_reflectance_sampling_rate"}) {
        bsdf.ignore(name);
    }
    return {"burley", std::move(p), !transmits};
}

/// The same model as pbrt's, for a fibre of radius 1.
Model Models::hair(const Object& bsdf) {
    Parameters p(bsdf.place());
    p.real("eta", index_of(bsdf, "int_ior", "amber") / index_of(bsdf, "ext_ior", "air"))
        .real("beta_m", bsdf.non_negative("longitudinal_roughness", 0.3))
        .real("beta_n", bsdf.non_negative("azimuthal_roughness", 0.3))
        .real("alpha", bsdf.number("scale_tilt", 2));
    if (!bsdf.has("sigma_a")) {
        p.real("eumelanin", bsdf.non_negative("eumelanin", 1.3))
            .real("pheomelanin", bsdf.non_negative("pheomelanin", 0.2));
        bsdf.ignore("scale");
        return {"hair", std::move(p), false};
    }
    if (bsdf.has("eumelanin") || bsdf.has("pheomelanin")) {
        throw InputError(bsdf.place_of("sigma_a"), "hair takes either pigments or \"sigma_a\"");
    }
    const auto scale = static_cast<float>(bsdf.non_negative("scale", 1));
    p.colour("sigma_a", colour_of(bsdf, "sigma_a", SpectrumUse::unbounded, Rgb(0.0f)) * scale);
    return {"hair", std::move(p), false};
}

Model Models::thin(const Object& bsdf) {
    Parameters p(bsdf.place());
    p.colour("reflectance", textures_.colour(bsdf, "base_color", Rgb(0.5f)))
        .real("roughness", textures_.number(bsdf, "roughness", 0.5))
        .real("eta", bsdf.positive("eta", 1.5));
    for (const auto& [name, parameter] :
         {std::pair{"anisotropic", "anisotropy"}, std::pair{"spec_trans", "transmission"},
          std::pair{"diff_trans", "diffusetransmission"}, std::pair{"spec_tint", "speculartint"},
          std::pair{"sheen", "sheen"}, std::pair{"sheen_tint", "sheentint"}, std::pair{"flatness", "flatness"}}) {
        if (bsdf.has(name)) {
            p.real(parameter, textures_.number(bsdf, name, 0));
        }
    }
    for (const char* name : {"specular_reflectance_sampling_rate", "specular_transmittance_sampling_rate",
                             "diffuse_reflectance_sampling_rate", "diffuse_transmittance_sampling_rate"}) {
        bsdf.ignore(name);
    }
    return {"burleysheet", std::move(p), false};
}

Model Models::measured(const Object& bsdf) {
    Parameters p(bsdf.place());
    p.text("filename", bsdf.file("filename").string());
    return {"measured", std::move(p)};
}

Model Models::replaced(const Object& bsdf) {
    if (!bsdf.is_one_of({"circular", "measured_polarized", "polarizer", "retarder"})) {
        refuse_type(bsdf, std::string(known_types));
    }
    context_.warn(bsdf.place(), fmt::format("{} is not implemented: a diffuse one takes its place", bsdf.title()));
    Parameters p(bsdf.place());
    p.colour("reflectance", Rgb(0.5f));
    return {"diffuse", std::move(p)};
}

}  // namespace wend::mitsuba
