#include <wend/core/contracts.h>
#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/bsdf/facet_albedo.h>
#include <wend/scene/bsdf/sheen.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// What light that is reflected several times among facets adds to single reflections, as a factor (kulla2017b): they
/// reflect `mean` of it, as a mean over directions.
Rgb several_times(const FacetAlbedo& facets, float cosine, float alpha, const Rgb& mean) {
    const float white = std::max(facets.white(cosine, alpha), 1e-3f), average = facets.mean_white(alpha);
    Rgb factor;
    for (int c = 0; c < 3; ++c) {
        factor[c] = 1 + mean[c] * average / (1 - mean[c] * (1 - average)) * (1 - white) / white;
    }
    return factor;
}

/// To [0, 1].
Rgb clamped(const Rgb& c) {
    return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

/// (1 - c)^5 of Schlick's reflectance is of this part of light that comes from everywhere, and c (1 - c)^6 of this one.
constexpr float mean_grazing = 1.0f / 21, mean_edge = 1.0f / 126;

/// What a metal of this edge tint lacks to Schlick's reflectance, over c (1 - c)^6 (kutz2021).
Rgb edge_of(const Rgb& base, const Rgb& tint) {
    constexpr float at = 6.0f / 7;  // 1 - c where the tint is
    const float grazing = sqr(sqr(at)) * at;
    const Rgb schlick = base + (Rgb(1.0f) - base) * grazing;
    return schlick * (Rgb(1.0f) - tint) * (7 / (grazing * at));
}

/// What facets without a gloss reflect once, for a base of 1: over 1 / pi, and what multiplies its change with
/// direction.
struct MattFacets {
    float even, change;

    explicit MattFacets(float roughness)
        : even(1 / (1 + (0.5f - 2 / (3 * pi)) * roughness)), change(roughness * even) {}

    /// Of light from a cosine.
    float albedo(float cosine) const {
        const float sine = safe_sqrt(1 - sqr(cosine)), angle = std::acos(std::min(cosine, 1.0f));
        // At grazing angles as a series: the tangent is not finite there.
        constexpr float grazing = 1e-4f;
        const float g = cosine < grazing ? 0.5f * pi - 2.0f / 3 - cosine
                                         : sine * (angle - 2.0f / 3 - sine * cosine) +
                                               2.0f / 3 * (sine / cosine) * (1 - sqr(sine) * sine);
        return even + change * g / pi;
    }
    float mean_albedo() const { return even + change * (2.0f / 3 - 28 / (15 * pi)); }
};

}  // namespace

struct PrincipledBsdf::Parts {
    float cosine;
    std::optional<Sheen> fibres;
    float uncovered = 1;  ///< left by the fibres
    Rgb left;             ///< by the coat as well
    float below;          ///< of that, for the base below the dielectric
    Rgb metal, facets;    ///< factors of their single reflections
    Rgb edge;             ///< edge_of() the metal
    float coat = 1;
    Rgb albedo_of_metal, albedo_of_facets;
    float albedo_of_coat;

    Parts(const PrincipledBsdf& b, const Vec3& wo) : cosine(std::min(std::abs(wo.z), 1.0f)) {
        const Rgb grazing = Rgb(1.0f) - b.base;
        const float white = b.below->white(cosine, b.alpha);
        edge = edge_of(b.base, b.specular_tint);
        metal = several_times(*b.below, cosine, b.alpha, b.base + grazing * mean_grazing - edge * mean_edge);
        // How an edge's tint differs by direction is little of the albedo.
        albedo_of_metal =
            (b.base * white + grazing * b.below->grazing(cosine, b.alpha) - edge * (mean_edge * white)) * metal;
        facets = several_times(*b.below, cosine, b.alpha, b.tinted(b.below->mean_fresnel()));
        // Of facets that reflect f, what they reflect in all is in proportion to it.
        const float once = white > 0 ? b.below->dielectric(cosine, b.alpha) / white : 0.0f;
        albedo_of_facets = clamped(b.tinted(once) * white * facets * b.specular);
        facets *= b.specular;
        albedo_of_coat = 0;
        if (b.coat > 0) {
            coat = several_times(*b.above, cosine, b.coat_alpha, Rgb(b.above->mean_fresnel())).r;
            albedo_of_coat = std::min(b.above->dielectric(cosine, b.coat_alpha) * coat, 1.0f);
        }
        if (b.sheen > 0) {
            fibres.emplace(wo, b.sheen_roughness);
            uncovered = 1 - b.sheen * max_value(b.sheen_tint) * fibres->albedo();
        }
        left = Rgb(uncovered * (1 - b.coat * albedo_of_coat));
        if (b.coat > 0 && b.coat_tint != Rgb(1.0f)) {
            const float aslant = 1 / std::sqrt(std::max(1 - (1 - sqr(cosine)) / sqr(b.coat_ior), 1e-4f));
            for (int c = 0; c < 3; ++c) {
                left[c] *= 1 + b.coat * (std::pow(b.coat_tint[c], aslant) - 1);
            }
        }
        below = 1 - max_value(albedo_of_facets);
    }
};

Rgb PrincipledBsdf::tinted(float fresnel) const {
    if (specular_tint == Rgb(1.0f)) {
        return Rgb(fresnel);
    }
    const float normal = sqr((ior - 1) / (ior + 1));
    const Rgb tint = specular_tint * normal;
    return tint + (Rgb(1.0f) - tint) * ((fresnel - normal) / (1 - normal));
}

Rgb PrincipledBsdf::diffuse_value(const Vec3& wo, const Vec3& wi) const {
    const float cos_o = std::min(std::abs(wo.z), 1.0f), cos_i = std::min(std::abs(wi.z), 1.0f);
    if (!(diffuse_roughness > 0)) {
        return base * (inv_pi * cos_i);
    }
    const MattFacets facets(diffuse_roughness);
    const float s = wo.x * wi.x + wo.y * wi.y, t = s > 0 ? s / std::max({cos_o, cos_i, 1e-6f}) : s;
    const float mean = facets.mean_albedo();
    const float lacking = (1 - facets.albedo(cos_o)) * (1 - facets.albedo(cos_i)) / (1 - mean);
    Rgb value = base * (facets.even + facets.change * t);
    for (int c = 0; c < 3; ++c) {
        value[c] += sqr(base[c]) * mean * lacking / (1 - base[c] * (1 - mean));
    }
    return value * (inv_pi * cos_i);
}

Rgb PrincipledBsdf::diffuse_albedo(float cosine) const {
    if (!(diffuse_roughness > 0)) {
        return base;
    }
    const MattFacets facets(diffuse_roughness);
    const float once = facets.albedo(cosine), mean = facets.mean_albedo();
    Rgb albedo = base * once;
    for (int c = 0; c < 3; ++c) {
        albedo[c] += sqr(base[c]) * mean * (1 - once) / (1 - base[c] * (1 - mean));
    }
    return albedo;
}

PrincipledBsdf::Shares PrincipledBsdf::shares(const Parts& parts) const {
    Shares shares;
    shares.sheen = parts.fibres ? sheen * mean_value(sheen_tint) * parts.fibres->albedo() : 0.0f;
    shares.coat = coat * parts.uncovered * parts.albedo_of_coat;
    const float left = mean_value(parts.left);
    shares.facets =
        left * (metallic * mean_value(parts.albedo_of_metal) + (1 - metallic) * mean_value(parts.albedo_of_facets));
    shares.base = left * (1 - metallic) * parts.below * (1 - subsurface) * mean_value(base);
    shares.entry = left * (1 - metallic) * parts.below * subsurface;
    const float sum = shares.coat + shares.facets + shares.base + shares.entry + shares.sheen;
    if (!(sum > 0)) {
        return {0, 1, 0, 0, 0};
    }
    // What is dark from here may be bright at grazing angles.
    constexpr float least = 0.05f;
    shares.coat = coat > 0 ? std::max(shares.coat / sum, least) : 0.0f;
    shares.facets = std::max(shares.facets / sum, least);
    shares.base = metallic < 1 && subsurface < 1 ? std::max(shares.base / sum, least) : 0.0f;
    shares.entry /= sum;
    shares.sheen /= sum;
    const float all = shares.coat + shares.facets + shares.base + shares.entry + shares.sheen;
    return {shares.coat / all, shares.facets / all, shares.base / all, shares.entry / all, shares.sheen / all};
}

float PrincipledBsdf::entry_density(const Vec3& wo, const Vec3& wi) const {
    const float refracted =
        entry_even < 1 ? DielectricBsdf{entry_ior, entry_alpha, entry_alpha}.refraction_density(wo, wi) : 0.0f;
    return entry_even * cosine_hemisphere_density(std::abs(wi.z)) + (1 - entry_even) * refracted;
}

std::optional<Vec3> PrincipledBsdf::sample_entry(const Vec3& wo, float u, const Vec2& u2) const {
    if (u < entry_even) {
        return -to_cosine_hemisphere(u2);
    }
    const auto s = DielectricBsdf{entry_ior, entry_alpha, entry_alpha}.sample_refraction(wo, u2);
    return s ? std::optional(s->direction) : std::nullopt;
}

Rgb PrincipledBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    if (has_inside && wo.z < 0) {
        return Rgb(std::max(wi.z, 0.0f) * inv_pi);
    }
    if (has_inside && wi.z < 0) {
        const Parts parts(*this, wo);
        return parts.left * ((1 - metallic) * parts.below * subsurface * entry_density(wo, wi));
    }
    const Vec3 sum = wo + wi;
    if (!(wo.z * wi.z > 0) || length_squared(sum) == 0) {
        return Rgb(0.0f);
    }
    const Parts parts(*this, wo);
    const Vec3 m = normalize(sum);
    const float c = abs_dot(wo, m);
    const auto reflected = [&](const Microfacets& of) { return of.d(m) * of.g(wo, wi) / (4 * std::abs(wo.z)); };
    const float single = reflected(facets()), aslant = 1 - std::min(c, 1.0f), grazing = std::pow(aslant, 5.0f);
    const Rgb metal = clamped(base + (Rgb(1.0f) - base) * grazing - parts.edge * (c * grazing * aslant)) * parts.metal;
    const Rgb glossy = parts.facets * tinted(fresnel_dielectric(c, ior));
    const Rgb diffuse = diffuse_value(wo, wi) * (parts.below * (1 - subsurface));
    Rgb value = (metal * metallic * single + (glossy * single + diffuse) * (1 - metallic)) * parts.left;
    if (coat > 0) {
        value += Rgb(parts.uncovered * coat * parts.coat * fresnel_dielectric(c, coat_ior) *
                     reflected({coat_alpha, coat_alpha}));
    }
    if (parts.fibres) {
        value += sheen_tint * (sheen * parts.fibres->albedo() * parts.fibres->density(wi));
    }
    return value;
}

float PrincipledBsdf::density(const Vec3& wo, const Vec3& wi) const {
    if (has_inside && wo.z < 0) {
        return cosine_hemisphere_density(std::max(wi.z, 0.0f));
    }
    if (has_inside && wi.z < 0) {
        return shares(Parts(*this, wo)).entry * entry_density(wo, wi);
    }
    Vec3 m = wo + wi;
    if (!(wo.z * wi.z > 0) || length_squared(m) == 0) {
        return 0;
    }
    m = normalize(m);
    m = m.z < 0 ? -m : m;
    const Parts parts(*this, wo);
    const Shares share = shares(parts);
    const auto reflected = [&](const Microfacets& of) { return of.visible_density(wo, m) / (4 * abs_dot(wo, m)); };
    float density = share.facets * reflected(facets()) + share.base * cosine_hemisphere_density(std::abs(wi.z));
    if (share.coat > 0) {
        density += share.coat * reflected({coat_alpha, coat_alpha});
    }
    return parts.fibres ? density + share.sheen * parts.fibres->density(wi) : density;
}

std::optional<BsdfSample> PrincipledBsdf::sample(const Vec3& wo, float u, const Vec2& u2) const {
    if (wo.z == 0) {
        return std::nullopt;
    }
    if (has_inside && wo.z < 0) {
        const Vec3 wi = to_cosine_hemisphere(u2);
        const float p = density(wo, wi);
        return p > 0 ? std::optional(BsdfSample{wi, evaluate(wo, wi), p}) : std::nullopt;
    }
    const Parts parts(*this, wo);
    const Shares share = shares(parts);
    Vec3 wi;
    if (u > 1 - share.entry) {
        const auto entered = sample_entry(wo, (1 - u) / share.entry, u2);
        if (!entered) {
            return std::nullopt;
        }
        wi = *entered;
    } else if (u < share.base) {
        wi = to_cosine_hemisphere(u2);
        wi.z = wo.z < 0 ? -wi.z : wi.z;
    } else if (u < share.base + share.sheen) {
        wi = parts.fibres->sample(u2);
    } else {
        const Microfacets of =
            u < share.base + share.sheen + share.facets ? facets() : Microfacets(coat_alpha, coat_alpha);
        const Vec3 m = of.sample_visible(wo, u2);
        wi = m * (2 * dot(wo, m)) - wo;
        // Below, it is not what goes in.
        if (!(wo.z * wi.z > 0)) {
            return std::nullopt;
        }
    }
    const float p = density(wo, wi);
    if (!(p > 0)) {
        return std::nullopt;
    }
    return BsdfSample{wi, evaluate(wo, wi), p};
}

Rgb PrincipledBsdf::albedo(const Vec3& wo) const {
    const Parts parts(*this, wo);
    const Rgb dielectric = parts.albedo_of_facets + diffuse_albedo(parts.cosine) * parts.below;
    return (parts.albedo_of_metal * metallic + dielectric * (1 - metallic)) * parts.left +
           Rgb(coat * parts.uncovered * parts.albedo_of_coat) +
           (parts.fibres ? sheen_tint * (sheen * parts.fibres->albedo()) : Rgb(0.0f));
}

}  // namespace wend
