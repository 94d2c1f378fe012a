#include <wend/scene/material.h>

#include <wend/core/contracts.h>
#include <wend/core/random.h>

#include <algorithm>
#include <bit>
#include <cmath>

namespace wend {
namespace {

Rgb clamp01(const Rgb& c) {
    return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

struct Alpha {
    float x, y;
};

Alpha alpha_at(const Roughness& roughness, const Textures& textures, const TexturePoint& p) {
    const auto one = [&](TextureId id) {
        const float r = std::max(textures.evaluate_grey(id, p), 0.0f);
        return roughness.remap ? std::sqrt(r) : r;
    };
    return {one(roughness.u), one(roughness.v)};
}

Bsdf bsdf_of(const DiffuseMaterial& m, const Textures& textures, const TexturePoint& p) {
    return LambertBsdf{clamp01(textures.evaluate(m.reflectance, p))};
}

Bsdf bsdf_of(const DiffuseTransmissionMaterial& m, const Textures& textures, const TexturePoint& p) {
    return DiffuseTransmissionBsdf{clamp01(textures.evaluate(m.reflectance, p) * m.scale),
                                   clamp01(textures.evaluate(m.transmittance, p) * m.scale)};
}

/// 1 where there is no texture.
Rgb factor_of(TextureId texture, const Textures& textures, const TexturePoint& p) {
    return texture < 0 ? Rgb(1.0f) : clamp01(textures.evaluate(texture, p));
}

/// `around`: index of what is around the metal.
ConductorBsdf metal_of(const ConductorMaterial& m, const Textures& textures, const TexturePoint& p, float around) {
    const Alpha alpha = alpha_at(m.roughness, textures, p);
    ConductorBsdf metal{Rgb(1.0f), Rgb(0.0f), alpha.x, alpha.y, m.roughness.slopes, factor_of(m.tint, textures, p)};
    if (m.reflectance < 0) {
        metal.eta = textures.evaluate(m.eta, p);
        metal.k = textures.evaluate(m.k, p);
    } else {
        // With eta = 1 the normal reflectance is k²/(4 + k²).
        const Rgb r = clamp01(textures.evaluate(m.reflectance, p));
        for (int c = 0; c < 3; ++c) {
            metal.k[c] = 2 * std::sqrt(std::min(r[c], 0.9999f) / (1 - std::min(r[c], 0.9999f)));
        }
    }
    metal.eta = metal.eta / around;
    metal.k = metal.k / around;
    return metal;
}

Bsdf bsdf_of(const ConductorMaterial& m, const Textures& textures, const TexturePoint& p) {
    return metal_of(m, textures, p, 1);
}

Bsdf bsdf_of(const DielectricMaterial& m, const Textures& textures, const TexturePoint& p) {
    const Alpha alpha = alpha_at(m.roughness, textures, p);
    DielectricBsdf bsdf{m.ior, alpha.x, alpha.y};
    bsdf.slopes = m.roughness.slopes;
    bsdf.reflectance = factor_of(m.reflectance, textures, p);
    bsdf.transmittance = factor_of(m.transmittance, textures, p);
    bsdf.is_antireflective = m.is_antireflective;
    return bsdf;
}

Bsdf bsdf_of(const ThinDielectricMaterial& m, const Textures& textures, const TexturePoint& p) {
    return ThinDielectricBsdf{m.ior, factor_of(m.reflectance, textures, p), factor_of(m.transmittance, textures, p)};
}

/// Different for different points.
std::uint64_t seed_of(const Vec3& position) {
    return hash_of(std::bit_cast<std::uint32_t>(position.x), std::bit_cast<std::uint32_t>(position.y),
                   std::bit_cast<std::uint32_t>(position.z));
}

/// The reflectance r of which the series r + r² returned + ... is in proportion to the colour, and 1 for white.
Rgb darkened(const Rgb& colour, float returned) {
    const auto channel = [&](float c) { return c / (1 - returned + c * returned); };
    return {channel(colour.r), channel(colour.g), channel(colour.b)};
}

Bsdf bsdf_of(const CoatedMaterial& m, const Textures& textures, const TexturePoint& p) {
    const Alpha alpha = alpha_at(m.roughness, textures, p);
    CoatedBsdf b;
    b.coat = {m.ior, alpha.x, alpha.y};
    b.coat.slopes = m.roughness.slopes;
    if (const auto* diffuse = std::get_if<DiffuseMaterial>(&m.base)) {
        const Rgb colour = clamp01(textures.evaluate(diffuse->reflectance, p));
        b.base = LambertBsdf{m.is_linear && m.returned >= 0 ? darkened(colour, m.returned) : colour};
    } else {
        b.base = metal_of(std::get<ConductorMaterial>(m.base), textures, p, m.ior);
    }
    b.thickness = std::max(textures.evaluate_grey(m.thickness, p), 1e-6f);
    b.albedo = clamp01(textures.evaluate(m.albedo, p));
    b.mean_cosine = std::clamp(textures.evaluate_grey(m.mean_cosine, p), -0.99f, 0.99f);
    b.max_depth = m.max_depth;
    b.walks = m.walks;
    b.returned = m.returned;
    b.seed = seed_of(p.position);
    return b;
}

Rgb absorption_of(const HairMaterial& m, const Textures& textures, const TexturePoint& p, float roughness_across) {
    if (m.given == HairMaterial::Colour::absorption) {
        return textures.evaluate(m.colour, p);
    }
    if (m.given == HairMaterial::Colour::pigments) {
        // Per unit of concentration (deon2011), as pbrt has it.
        const auto amount = [&](TextureId id) { return id < 0 ? 0.0f : std::max(textures.evaluate_grey(id, p), 0.0f); };
        return Rgb(0.419f, 0.697f, 1.37f) * amount(m.eumelanin) + Rgb(0.187f, 0.4f, 1.05f) * amount(m.pheomelanin);
    }
    // chiang2016's fit of what the multiple scattering of a head of hair makes of it.
    const float n = roughness_across;
    const float fit = 5.969f + n * (-0.215f + n * (2.532f + n * (-10.73f + n * (5.574f + n * 0.245f))));
    const Rgb colour = clamp01(textures.evaluate(m.colour, p));
    Rgb absorption;
    for (int c = 0; c < 3; ++c) {
        absorption[c] = sqr(std::log(std::max(colour[c], 1e-4f)) / fit);
    }
    return absorption;
}

Bsdf bsdf_of(const HairMaterial& m, const Textures& textures, const TexturePoint& p) {
    const auto value = [&](TextureId id) { return textures.evaluate_grey(id, p); };
    const float across = std::clamp(value(m.roughness_across), 0.01f, 1.0f);
    return HairBsdf(2 * p.uv.y - 1, std::max(value(m.ior), 1.001f), absorption_of(m, textures, p, across),
                    value(m.roughness_along), across, value(m.tilt) * (pi / 180));
}

/// How much rougher brushed facets are along one direction, and smoother across it (burley2012).
float aspect_of(float anisotropy) {
    return std::sqrt(1 - 0.9f * anisotropy);
}

Bsdf bsdf_of(const DisneyMaterial& m, const Textures& textures, const TexturePoint& p) {
    const auto share = [&](TextureId id) { return std::clamp(textures.evaluate_grey(id, p), 0.0f, 1.0f); };
    constexpr float least_alpha = 1e-3f;
    DisneyBsdf b;
    b.base = clamp01(textures.evaluate(m.base, p));
    b.roughness = share(m.roughness);
    const float alpha = sqr(b.roughness), aspect = aspect_of(share(m.anisotropy));
    b.alpha_x = std::max(alpha / aspect, least_alpha);
    b.alpha_y = std::max(alpha * aspect, least_alpha);
    b.ior = m.ior;
    b.metallic = share(m.metallic);
    b.spec_trans = m.transmits ? std::max(share(m.spec_trans), 1e-6f) : 0.0f;
    b.spec_tint = share(m.spec_tint);
    b.sheen = std::max(textures.evaluate_grey(m.sheen, p), 0.0f);
    b.sheen_tint = share(m.sheen_tint);
    b.flatness = share(m.flatness);
    b.coat = std::max(textures.evaluate_grey(m.coat, p), 0.0f);
    b.coat_alpha = 0.1f + (0.001f - 0.1f) * share(m.coat_gloss);
    return b;
}

Bsdf bsdf_of(const DisneySheetMaterial& m, const Textures& textures, const TexturePoint& p) {
    const auto share = [&](TextureId id) { return std::clamp(textures.evaluate_grey(id, p), 0.0f, 1.0f); };
    constexpr float least_alpha = 1e-3f;
    DisneySheetBsdf b;
    b.base = clamp01(textures.evaluate(m.base, p));
    b.roughness = share(m.roughness);
    b.ior = m.ior;
    // What passes two facets is bent back by the second: less is left of their roughness (burley2015).
    const float bent = sqr((0.65f * b.ior - 0.35f) * b.roughness), alpha = sqr(b.roughness);
    const float aspect = aspect_of(share(m.anisotropy));
    b.alpha_x = std::max(alpha / aspect, least_alpha);
    b.alpha_y = std::max(alpha * aspect, least_alpha);
    b.passing_alpha_x = std::max(bent / aspect, least_alpha);
    b.passing_alpha_y = std::max(bent * aspect, least_alpha);
    b.spec_trans = share(m.spec_trans);
    b.diff_trans = std::clamp(textures.evaluate_grey(m.diff_trans, p) / 2, 0.0f, 1.0f);
    b.spec_tint = share(m.spec_tint);
    b.sheen = std::max(textures.evaluate_grey(m.sheen, p), 0.0f);
    b.sheen_tint = share(m.sheen_tint);
    b.flatness = share(m.flatness);
    return b;
}

Bsdf bsdf_of(const PrincipledMaterial& m, const Textures& textures, const TexturePoint& p) {
    const auto share = [&](TextureId id) { return std::clamp(textures.evaluate_grey(id, p), 0.0f, 1.0f); };
    const auto alpha = [&](TextureId roughness) {
        return std::max(sqr(share(roughness)), PrincipledBsdf::least_alpha);
    };
    const auto factor = [&](TextureId id) { return id < 0 ? Rgb(1.0f) : clamp01(textures.evaluate(id, p)); };
    PrincipledBsdf b;
    b.base = clamp01(textures.evaluate(m.base, p));
    b.metallic = share(m.metallic);
    b.alpha = alpha(m.roughness);
    b.ior = m.ior;
    b.specular = std::max(textures.evaluate_grey(m.specular, p), 0.0f);
    b.coat = share(m.coat);
    b.coat_alpha = alpha(m.coat_roughness);
    b.coat_ior = m.coat_ior;
    b.aspect = m.anisotropy < 0 ? 1.0f : aspect_of(share(m.anisotropy));
    b.specular_tint = factor(m.specular_tint);
    b.coat_tint = factor(m.coat_tint);
    b.diffuse_roughness = m.diffuse_roughness < 0 ? 0.0f : share(m.diffuse_roughness);
    if (m.sheen >= 0) {
        b.sheen = share(m.sheen);
        b.sheen_tint = factor(m.sheen_tint);
        b.sheen_roughness = share(m.sheen_roughness);
    }
    if (m.subsurface >= 0) {
        b.has_inside = true;
        b.subsurface = share(m.subsurface);
        b.entry_ior = m.entry_ior;
        // What is smoother is a mirror to DielectricBsdf, and has no density.
        constexpr float least_entry_alpha = 2e-3f;
        b.entry_alpha = std::max(alpha(m.entry_roughness), least_entry_alpha);
        b.entry_even = m.entry_even;
    }
    b.below = m.below.get();
    b.above = m.above.get();
    return b;
}

Bsdf bsdf_of(const MeasuredMaterial& m, const Textures&, const TexturePoint&) {
    return MeasuredBsdf{m.tables.get()};
}

Bsdf bsdf_of(const MixMaterial&, const Textures&, const TexturePoint&) {
    WEND_EXPECT(false);
    return LambertBsdf{};
}

Bsdf bsdf_of(const InterfaceMaterial&, const Textures&, const TexturePoint&) {
    WEND_EXPECT(false);
    return LambertBsdf{};
}

}  // namespace

Bsdf make_bsdf(const Material& material, const Textures& textures, const TexturePoint& p) {
    return std::visit([&](const auto& m) { return bsdf_of(m, textures, p); }, material);
}

bool is_directed(const Material& material) {
    struct Directed {
        static bool of(const Roughness& roughness) { return roughness.u != roughness.v; }
        bool operator()(const DiffuseMaterial&) const { return false; }
        bool operator()(const DiffuseTransmissionMaterial&) const { return false; }
        bool operator()(const ThinDielectricMaterial&) const { return false; }
        bool operator()(const InterfaceMaterial&) const { return false; }
        bool operator()(const ConductorMaterial& m) const { return of(m.roughness); }
        bool operator()(const DielectricMaterial& m) const { return of(m.roughness); }
        bool operator()(const CoatedMaterial& m) const { return of(m.roughness) || std::visit(*this, m.base); }
        bool operator()(const PrincipledMaterial& m) const { return m.anisotropy >= 0; }
        bool operator()(const HairMaterial&) const { return true; }
        bool operator()(const MeasuredMaterial&) const { return true; }
        bool operator()(const DisneyMaterial&) const { return true; }
        bool operator()(const DisneySheetMaterial&) const { return true; }
        bool operator()(const MixMaterial&) const { return true; }
    };
    return std::visit(Directed{}, material);
}

MaterialPart material_at(const std::vector<Material>& materials, int index, const Textures& textures,
                         const TexturePoint& p) {
    MaterialPart part{index};
    while (const auto* mix = std::get_if<MixMaterial>(&materials[static_cast<std::size_t>(part.index)])) {
        const float u = to_unit_float(static_cast<std::uint32_t>(hash_of(seed_of(p.position), part.index) >> 32));
        float amount = textures.evaluate_grey(mix->amount, p);
        if (mix->is_sum) {
            // Neither is ever left out.
            constexpr float least = 1e-3f;
            amount = std::clamp(amount, least, 1 - least);
            part.count /= u < amount ? amount : 1 - amount;
        }
        part.index = u < amount ? mix->second : mix->first;
    }
    return part;
}

}  // namespace wend
