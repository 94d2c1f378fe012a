#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/scene/bsdf/bsdf.h>

namespace wend {

Rgb ConductorBsdf::reflectance(float cosine) const {
    return tint * Rgb(fresnel_conductor(cosine, eta.r, k.r), fresnel_conductor(cosine, eta.g, k.g),
                      fresnel_conductor(cosine, eta.b, k.b));
}

bool ConductorBsdf::is_specular() const {
    return Microfacets::is_smooth(alpha_x, alpha_y);
}

Rgb ConductorBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    if (is_specular() || !(wo.z * wi.z > 0)) {
        return Rgb(0.0f);
    }
    const Vec3 sum = wo + wi;
    if (length_squared(sum) == 0) {
        return Rgb(0.0f);
    }
    const Vec3 m = normalize(sum);
    const Microfacets facets(alpha_x, alpha_y, slopes);
    return reflectance(abs_dot(wo, m)) * (facets.d(m) * facets.g(wo, wi) / (4 * std::abs(wo.z)));
}

float ConductorBsdf::density(const Vec3& wo, const Vec3& wi) const {
    if (is_specular() || !(wo.z * wi.z > 0)) {
        return 0;
    }
    Vec3 m = wo + wi;
    if (length_squared(m) == 0) {
        return 0;
    }
    m = normalize(m);
    m = m.z < 0 ? -m : m;
    return Microfacets(alpha_x, alpha_y, slopes).visible_density(wo, m) / (4 * abs_dot(wo, m));
}

std::optional<BsdfSample> ConductorBsdf::sample(const Vec3& wo, float, const Vec2& u2) const {
    if (wo.z == 0) {
        return std::nullopt;
    }
    if (is_specular()) {
        return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance(std::abs(wo.z)), 1, true};
    }
    const Microfacets facets(alpha_x, alpha_y, slopes);
    const Vec3 m = facets.sample_visible(wo, u2);
    if (!facets.is_visible(wo, m)) {
        return std::nullopt;
    }
    const Vec3 wi = m * (2 * dot(wo, m)) - wo;
    const float p = density(wo, wi);
    if (!(p > 0)) {
        return std::nullopt;
    }
    return BsdfSample{wi, evaluate(wo, wi), p};
}

}  // namespace wend
