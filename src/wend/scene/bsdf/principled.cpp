#include <wend/core/contracts.h>
#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/bsdf/facet_albedo.h>

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

/// (1 - c)^5 of Schlick's reflectance is of this part of light that comes from everywhere.
constexpr float mean_grazing = 1.0f / 21;

}  // namespace

struct PrincipledBsdf::Parts {
    float cosine;
    float left;         ///< by the coat
    float below;        ///< of that, for the base below the dielectric
    Rgb metal, facets;  ///< factors of their single reflections
    float coat = 1;
    Rgb albedo_of_metal;
    float albedo_of_facets, albedo_of_coat;

    Parts(const PrincipledBsdf& b, const Vec3& wo) : cosine(std::min(std::abs(wo.z), 1.0f)) {
        const Rgb grazing = Rgb(1.0f) - b.base;
        metal = several_times(*b.below, cosine, b.alpha, b.base + grazing * mean_grazing);
        albedo_of_metal =
            (b.base * b.below->white(cosine, b.alpha) + grazing * b.below->grazing(cosine, b.alpha)) * metal;
        facets = several_times(*b.below, cosine, b.alpha, Rgb(b.below->mean_fresnel()));
        albedo_of_facets = std::min(b.specular * b.below->dielectric(cosine, b.alpha) * facets.r, 1.0f);
        facets *= b.specular;
        albedo_of_coat = 0;
        if (b.coat > 0) {
            coat = several_times(*b.above, cosine, b.coat_alpha, Rgb(b.above->mean_fresnel())).r;
            albedo_of_coat = std::min(b.above->dielectric(cosine, b.coat_alpha) * coat, 1.0f);
        }
        left = 1 - b.coat * albedo_of_coat;
        below = 1 - albedo_of_facets;
    }
};

PrincipledBsdf::Shares PrincipledBsdf::shares(const Parts& parts) const {
    Shares shares;
    shares.coat = coat * parts.albedo_of_coat;
    shares.facets =
        parts.left * (metallic * mean_value(parts.albedo_of_metal) + (1 - metallic) * parts.albedo_of_facets);
    shares.base = parts.left * (1 - metallic) * parts.below * (1 - subsurface) * mean_value(base);
    shares.entry = parts.left * (1 - metallic) * parts.below * subsurface;
    const float sum = shares.coat + shares.facets + shares.base + shares.entry;
    if (!(sum > 0)) {
        return {0, 1, 0, 0};
    }
    // What is dark from here may be bright at grazing angles.
    constexpr float least = 0.05f;
    shares.coat = coat > 0 ? std::max(shares.coat / sum, least) : 0.0f;
    shares.facets = std::max(shares.facets / sum, least);
    shares.base = metallic < 1 && subsurface < 1 ? std::max(shares.base / sum, least) : 0.0f;
    shares.entry /= sum;
    const float all = shares.coat + shares.facets + shares.base + shares.entry;
    return {shares.coat / all, shares.facets / all, shares.base / all, shares.entry / all};
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
        return Rgb(parts.left * (1 - metallic) * parts.below * subsurface * entry_density(wo, wi));
    }
    const Vec3 sum = wo + wi;
    if (!(wo.z * wi.z > 0) || length_squared(sum) == 0) {
        return Rgb(0.0f);
    }
    const Parts parts(*this, wo);
    const Vec3 m = normalize(sum);
    const float c = abs_dot(wo, m);
    const auto reflected = [&](float roughness) {
        const Microfacets of(roughness, roughness);
        return of.d(m) * of.g(wo, wi) / (4 * std::abs(wo.z));
    };
    const float single = reflected(alpha);
    const Rgb metal = (base + (Rgb(1.0f) - base) * std::pow(1 - std::min(c, 1.0f), 5.0f)) * parts.metal;
    const Rgb facets = parts.facets * fresnel_dielectric(c, ior);
    const Rgb diffuse = base * (parts.below * (1 - subsurface) * inv_pi * std::abs(wi.z));
    Rgb value = (metal * metallic * single + (facets * single + diffuse) * (1 - metallic)) * parts.left;
    if (coat > 0) {
        value += Rgb(coat * parts.coat * fresnel_dielectric(c, coat_ior) * reflected(coat_alpha));
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
    const Shares share = shares(Parts(*this, wo));
    const auto reflected = [&](float roughness) {
        return Microfacets(roughness, roughness).visible_density(wo, m) / (4 * abs_dot(wo, m));
    };
    float density = share.facets * reflected(alpha) + share.base * cosine_hemisphere_density(std::abs(wi.z));
    if (share.coat > 0) {
        density += share.coat * reflected(coat_alpha);
    }
    return density;
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
    const Shares share = shares(Parts(*this, wo));
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
    } else {
        const float roughness = u < share.base + share.facets ? alpha : coat_alpha;
        const Vec3 m = Microfacets(roughness, roughness).sample_visible(wo, u2);
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
    const Rgb dielectric = Rgb(parts.albedo_of_facets) + base * parts.below;
    return (parts.albedo_of_metal * metallic + dielectric * (1 - metallic)) * parts.left +
           Rgb(coat * parts.albedo_of_coat);
}

}  // namespace wend
