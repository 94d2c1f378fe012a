#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/scene/bsdf/bsdf.h>

namespace wend {
namespace {

/// The microfacet that reflects or refracts wo into wi, and the ratio of indices beyond and before (1 for a
/// reflection).
struct Facet {
    Vec3 normal;
    float index_ratio;
    bool reflects;
};

std::optional<Facet> facet_between(const DielectricBsdf& b, const Vec3& wo, const Vec3& wi) {
    if (wo.z == 0 || wi.z == 0) {
        return std::nullopt;
    }
    const bool reflects = wo.z * wi.z > 0;
    const float ratio = reflects ? 1.0f : (wo.z > 0 ? b.ior : 1 / b.ior);
    Vec3 m = wi * ratio + wo;
    if (length_squared(m) == 0) {
        return std::nullopt;
    }
    m = normalize(m);
    m = m.z < 0 ? -m : m;
    // Facets seen from behind do not exist.
    if (dot(m, wi) * wi.z < 0 || dot(m, wo) * wo.z < 0) {
        return std::nullopt;
    }
    return Facet{m, ratio, reflects};
}

}  // namespace

float DielectricBsdf::reflection_probability(float fresnel) const {
    const float reflected = fresnel * odds;
    // Exactly Fresnel's where nothing is preferred, and where everything is reflected.
    return odds == 1 || fresnel == 1
               ? fresnel
               : fresnel_share * fresnel + (1 - fresnel_share) * reflected / (reflected + 1 - fresnel);
}

float DielectricBsdf::reflected_share(float cosine) const {
    const float share = fresnel_dielectric(cosine, ior);
    return is_antireflective && share < 1 ? 0 : share;
}

bool DielectricBsdf::is_specular() const {
    return ior == 1 || Microfacets::is_smooth(alpha_x, alpha_y);
}

Rgb DielectricBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    if (is_specular()) {
        return Rgb(0.0f);
    }
    const auto facet = facet_between(*this, wo, wi);
    if (!facet) {
        return Rgb(0.0f);
    }
    const Microfacets facets(alpha_x, alpha_y, slopes);
    const Vec3& m = facet->normal;
    const float f = reflected_share(dot(wo, m));
    if (facet->reflects) {
        return reflectance * (facets.d(m) * facets.g(wo, wi) * f / (4 * std::abs(wo.z)));
    }
    const float n = facet->index_ratio;
    const float denominator = sqr(dot(wi, m) + dot(wo, m) / n);
    // The factor 1/n² is that of radiance.
    return transmittance * ((1 - f) * facets.d(m) * facets.g(wo, wi) * abs_dot(wi, m) * abs_dot(wo, m) /
                            (denominator * std::abs(wo.z) * n * n));
}

float DielectricBsdf::density(const Vec3& wo, const Vec3& wi) const {
    if (is_specular()) {
        return 0;
    }
    const auto facet = facet_between(*this, wo, wi);
    if (!facet) {
        return 0;
    }
    const Microfacets facets(alpha_x, alpha_y, slopes);
    const Vec3& m = facet->normal;
    const float f = reflected_share(dot(wo, m));
    const float reflection = reflection_probability(f);
    if (facet->reflects) {
        return reflection * facets.visible_density(wo, m) / (4 * abs_dot(wo, m));
    }
    const float denominator = sqr(dot(wi, m) + dot(wo, m) / facet->index_ratio);
    return (1 - reflection) * facets.visible_density(wo, m) * abs_dot(wi, m) / denominator;
}

float DielectricBsdf::refraction_density(const Vec3& wo, const Vec3& wi) const {
    const auto facet = is_specular() ? std::nullopt : facet_between(*this, wo, wi);
    if (!facet || facet->reflects) {
        return 0;
    }
    const Vec3& m = facet->normal;
    const float denominator = sqr(dot(wi, m) + dot(wo, m) / facet->index_ratio);
    return Microfacets(alpha_x, alpha_y, slopes).visible_density(wo, m) * abs_dot(wi, m) / denominator;
}

Vec3 DielectricBsdf::sample_facet(const Vec3& wo, const Vec2& u2) const {
    return is_specular() ? Vec3(0, 0, 1) : Microfacets(alpha_x, alpha_y, slopes).sample_visible(wo, u2);
}

std::optional<BsdfSample> DielectricBsdf::reflected(const Vec3& wo, const Vec3& m) const {
    if (!Microfacets(alpha_x, alpha_y, slopes).is_visible(wo, m)) {
        return std::nullopt;
    }
    const Vec3 wi = m * (2 * dot(wo, m)) - wo;
    if (is_specular()) {
        return BsdfSample{wi, reflectance * reflected_share(dot(wo, m)), 1, true};
    }
    const float p = Microfacets(alpha_x, alpha_y, slopes).visible_density(wo, m) / (4 * abs_dot(wo, m));
    return wo.z * wi.z > 0 && p > 0 ? std::optional(BsdfSample{wi, evaluate(wo, wi), p}) : std::nullopt;
}

std::optional<BsdfSample> DielectricBsdf::refracted(const Vec3& wo, const Vec3& m) const {
    const auto refraction = refract(wo, m, ior);
    if (!Microfacets(alpha_x, alpha_y, slopes).is_visible(wo, m) || !refraction || wo.z * refraction->direction.z > 0 ||
        refraction->direction.z == 0) {
        return std::nullopt;
    }
    const Vec3& wi = refraction->direction;
    if (is_specular()) {
        return BsdfSample{wi, transmittance * ((1 - reflected_share(dot(wo, m))) / sqr(refraction->ior)), 1, true};
    }
    const float p = refraction_density(wo, wi);
    return p > 0 ? std::optional(BsdfSample{wi, evaluate(wo, wi), p}) : std::nullopt;
}

std::optional<BsdfSample> DielectricBsdf::sample_reflection(const Vec3& wo, const Vec2& u2) const {
    return wo.z == 0 ? std::nullopt : reflected(wo, sample_facet(wo, u2));
}

std::optional<BsdfSample> DielectricBsdf::sample_refraction(const Vec3& wo, const Vec2& u2) const {
    return wo.z == 0 ? std::nullopt : refracted(wo, sample_facet(wo, u2));
}

std::optional<BsdfSample> DielectricBsdf::sample(const Vec3& wo, float u, const Vec2& u2) const {
    if (wo.z == 0) {
        return std::nullopt;
    }
    const Vec3 m = sample_facet(wo, u2);
    const float f = reflected_share(dot(wo, m));
    const float reflection = reflection_probability(f);
    const bool reflects = u < reflection;
    auto s = reflects ? reflected(wo, m) : refracted(wo, m);
    if (s) {
        const float chosen = reflects ? reflection : 1 - reflection;
        s->density_ratio = chosen / (reflects ? f : 1 - f);
        s->density = s->specular ? chosen : density(wo, s->direction);
    }
    return s;
}

float index_ratio(const Bsdf& bsdf, const Vec3& wo, const Vec3& wi) {
    const auto* glass = std::get_if<DielectricBsdf>(&bsdf);
    const auto* disney = std::get_if<DisneyBsdf>(&bsdf);
    if ((!glass && !disney) || wo.z * wi.z >= 0) {
        return 1;
    }
    const float ior = glass ? glass->ior : disney->ior;
    return wo.z > 0 ? ior : 1 / ior;
}

}  // namespace wend
