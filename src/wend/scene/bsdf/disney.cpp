#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/bsdf/disney_terms.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Facets of the coat (GTR1 with an exponent of 1), by their density of normals per projected area.
float coat_facets(const Vec3& m, float alpha) {
    const float a2 = sqr(alpha);
    return (a2 - 1) / (pi * std::log(a2) * (1 + (a2 - 1) * sqr(m.z)));
}

Vec3 sample_coat_facet(float alpha, const Vec2& u) {
    const float a2 = sqr(alpha);
    const float cos2 = std::clamp((1 - std::pow(a2, 1 - u.x)) / (1 - a2), 0.0f, 1.0f);
    const float sine = std::sqrt(1 - cos2), phi = 2 * pi * u.y;
    return {sine * std::cos(phi), sine * std::sin(phi), std::sqrt(cos2)};
}

}  // namespace

/// How two directions meet at a facet.
struct DisneyBsdf::Meeting {
    bool reflects;
    float index;           ///< beyond over before; 1 where it reflects
    Vec3 m{0, 0, 1};       ///< z > 0
    float with_o, with_i;  ///< cosines, signed
    float fresnel;
};

std::optional<DisneyBsdf::Meeting> DisneyBsdf::meet(const Vec3& wo, const Vec3& wi) const {
    Meeting at{};
    at.reflects = wo.z * wi.z > 0;
    if (wo.z == 0 || wi.z == 0 || (!at.reflects && !(spec_trans > 0 && metallic < 1))) {
        return std::nullopt;
    }
    at.index = at.reflects ? 1.0f : wo.z > 0 ? ior : 1 / ior;
    const Vec3 sum = wo + wi * at.index;
    if (length_squared(sum) == 0) {
        return std::nullopt;
    }
    at.m = normalize(sum);
    at.m = at.m.z < 0 ? -at.m : at.m;
    at.with_o = dot(wo, at.m);
    at.with_i = dot(wi, at.m);
    // Of two that bend into each other, by the one in the thinner medium: the other is near the critical angle where
    // this one grazes, and would say little of it. So both ways have the same.
    const bool is_front_thin = ior > 1;
    at.fresnel = fresnel_dielectric(at.reflects || (wo.z > 0) == is_front_thin ? at.with_o : at.with_i, ior);
    const bool is_seen = at.with_o * wo.z > 0 && at.with_i * wi.z > 0;
    return is_seen ? std::optional(at) : std::nullopt;
}

Vec3 DisneyBsdf::to_front(const Vec3& w, const Vec3& wo) const {
    // What nothing passes is alike from both sides.
    return wo.z < 0 && !(spec_trans > 0) ? Vec3(w.x, w.y, -w.z) : w;
}

Rgb DisneyBsdf::facet_colour(const Meeting& at, bool is_front) const {
    if (!is_front) {
        return Rgb((1 - metallic) * spec_trans * at.fresnel);
    }
    // By Schlick; from the denser side, by the angle beyond.
    const bool is_denser_beyond = at.with_o > 0 ? ior > 1 : ior < 1;
    const float n = at.with_o > 0 ? ior : 1 / ior;
    const float beyond = safe_sqrt(1 - (1 - sqr(at.with_o)) / sqr(n));
    const float grazing = schlick_weight(is_denser_beyond ? std::abs(at.with_o) : beyond);
    return schlick(base, grazing) * metallic + Rgb((1 - metallic) * (1 - spec_tint) * at.fresnel) +
           schlick(hue_of(base) * sqr((n - 1) / (n + 1)), grazing) * ((1 - metallic) * spec_tint);
}

Rgb DisneyBsdf::diffuse_value(const Meeting& at, float cos_o, float cos_i) const {
    const float half = std::abs(at.with_i), matt = (1 - metallic) * (1 - spec_trans);
    if (!(matt > 0)) {
        return Rgb(0.0f);
    }
    return (base * (matt * inv_pi * matt_value(roughness, flatness, cos_o, cos_i, half)) +
            cloth_value(base, sheen, sheen_tint, half) * (1 - metallic)) *
           cos_i;
}

Rgb DisneyBsdf::evaluate(const Vec3& given_o, const Vec3& given_i) const {
    const Vec3 wo = to_front(given_o, given_o), wi = to_front(given_i, given_o);
    const auto at = meet(wo, wi);
    if (!at) {
        return Rgb(0.0f);
    }
    const Microfacets facets(alpha_x, alpha_y);
    // Each direction is masked by itself.
    const float d = facets.d(at->m) * facets.g1(wo) * facets.g1(wi);
    if (!at->reflects) {
        // The factor 1 / index² is that of radiance.
        const float passed = (1 - metallic) * spec_trans * (1 - at->fresnel) * d * std::abs(at->with_o * at->with_i) /
                             (std::abs(wo.z) * sqr(at->with_o + at->index * at->with_i));
        return Rgb(std::sqrt(base.r), std::sqrt(base.g), std::sqrt(base.b)) * passed;
    }
    const bool is_front = wo.z > 0;
    Rgb value = facet_colour(*at, is_front) * (d / (4 * std::abs(wo.z)));
    if (!is_front) {
        return value;
    }
    if (coat > 0) {
        constexpr float masked = 0.25f, normal = 0.04f;
        const Microfacets as_rough(masked, masked);
        const float fresnel = normal + (1 - normal) * schlick_weight(std::abs(at->with_o));
        value +=
            Rgb(0.25f * coat * fresnel * coat_facets(at->m, coat_alpha) * as_rough.g1(wo) * as_rough.g1(wi) * wi.z);
    }
    return value + diffuse_value(*at, wo.z, wi.z);
}

DisneyBsdf::Shares DisneyBsdf::shares(bool is_front) const {
    if (!is_front) {
        return {0, 0};
    }
    const float base_share = (1 - metallic) * (1 - spec_trans), coat_share = 0.25f * coat;
    const float all = 1 + base_share + coat_share;
    return {base_share / all, coat_share / all};
}

float DisneyBsdf::reflected_share(float fresnel, bool is_front) const {
    return is_front ? 1 - (1 - metallic) * spec_trans * (1 - fresnel) : fresnel;
}

float DisneyBsdf::density(const Vec3& given_o, const Vec3& given_i) const {
    const Vec3 wo = to_front(given_o, given_o), wi = to_front(given_i, given_o);
    const bool is_front = wo.z > 0;
    const Shares share = shares(is_front);
    const float even = wo.z * wi.z > 0 ? share.base * cosine_hemisphere_density(std::abs(wi.z)) : 0.0f;
    const auto at = meet(wo, wi);
    if (!at) {
        return even;
    }
    const float facets = (1 - share.base - share.coat) * Microfacets(alpha_x, alpha_y).visible_density(wo, at->m);
    const float reflected = reflected_share(at->fresnel, is_front);
    if (!at->reflects) {
        return facets * (1 - reflected) * sqr(at->index) * std::abs(at->with_i) /
               sqr(at->with_o + at->index * at->with_i);
    }
    const float coats = share.coat > 0 ? share.coat * coat_facets(at->m, coat_alpha) * at->m.z : 0.0f;
    return even + (facets * reflected + coats) / (4 * std::abs(at->with_o));
}

std::optional<Vec3> DisneyBsdf::sample_direction(const Vec3& wo, float u, const Vec2& u2) const {
    const Shares share = shares(wo.z > 0);
    if (u < share.base) {
        return to_cosine_hemisphere(u2);
    }
    if (u < share.base + share.coat) {
        const Vec3 m = sample_coat_facet(coat_alpha, u2);
        const Vec3 wi = m * (2 * dot(wo, m)) - wo;
        return wi.z > 0 ? std::optional(wi) : std::nullopt;
    }
    u = (u - share.base - share.coat) / (1 - share.base - share.coat);
    const Vec3 m = Microfacets(alpha_x, alpha_y).sample_visible(wo, u2);
    if (u < reflected_share(fresnel_dielectric(dot(wo, m), ior), wo.z > 0)) {
        const Vec3 wi = m * (2 * dot(wo, m)) - wo;
        return wi.z * wo.z > 0 ? std::optional(wi) : std::nullopt;
    }
    const auto bent = refract(wo, m, ior);
    return bent && bent->direction.z * wo.z < 0 ? std::optional(bent->direction) : std::nullopt;
}

std::optional<BsdfSample> DisneyBsdf::sample(const Vec3& given_o, float u, const Vec2& u2) const {
    const Vec3 wo = to_front(given_o, given_o);
    const auto drawn = wo.z != 0 ? sample_direction(wo, u, u2) : std::nullopt;
    if (!drawn) {
        return std::nullopt;
    }
    const Vec3 wi = to_front(*drawn, given_o);
    const float p = density(given_o, wi);
    return p > 0 ? std::optional(BsdfSample{wi, evaluate(given_o, wi), p}) : std::nullopt;
}

Rgb DisneyBsdf::albedo(const Vec3& wo) const {
    const float fresnel = fresnel_dielectric(to_front(wo, wo).z, ior), clear = (1 - metallic) * spec_trans;
    const Rgb passed(std::sqrt(base.r), std::sqrt(base.g), std::sqrt(base.b));
    return base * ((1 - metallic) * (1 - spec_trans) + metallic) + (passed * (1 - fresnel) + Rgb(fresnel)) * clear;
}

}  // namespace wend
