#include <wend/medium/fresnel.h>
#include <wend/medium/microfacet.h>
#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>

namespace wend {

float CoatedDiffuseBsdf::coat_probability(float cosine) const {
    const float f = fresnel_dielectric(cosine, ior);
    const float base = (1 - f) * mean(reflectance);
    return f / (f + base);
}

Rgb CoatedDiffuseBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    if (!(wo.z * wi.z > 0)) {
        return Rgb(0.0f);
    }
    const float cosine_o = std::abs(wo.z);
    const float cosine_i = std::abs(wi.z);
    const float transmitted = (1 - fresnel_dielectric(cosine_o, ior)) * (1 - fresnel_dielectric(cosine_i, ior));
    Rgb value;
    for (int c = 0; c < 3; ++c) {
        value[c] =
            reflectance[c] * transmitted * inv_pi * cosine_i / (sqr(ior) * (1 - reflectance[c] * inner_reflectance));
    }
    if (!Microfacets::is_smooth(alpha_x, alpha_y)) {
        const Vec3 m = normalize(wo + wi);
        const Microfacets facets(alpha_x, alpha_y);
        value = value + Rgb(fresnel_dielectric(abs_dot(wo, m), ior) * facets.d(m) * facets.g(wo, wi) / (4 * cosine_o));
    }
    return value;
}

float CoatedDiffuseBsdf::density(const Vec3& wo, const Vec3& wi) const {
    if (!(wo.z * wi.z > 0)) {
        return 0;
    }
    const float coat = coat_probability(std::abs(wo.z));
    float p = (1 - coat) * cosine_hemisphere_density(std::abs(wi.z));
    if (!Microfacets::is_smooth(alpha_x, alpha_y)) {
        Vec3 m = normalize(wo + wi);
        m = m.z < 0 ? -m : m;
        p += coat * Microfacets(alpha_x, alpha_y).visible_density(wo, m) / (4 * abs_dot(wo, m));
    }
    return p;
}

std::optional<BsdfSample> CoatedDiffuseBsdf::sample(const Vec3& wo, float u, const Vec2& u2) const {
    if (wo.z == 0) {
        return std::nullopt;
    }
    const float coat = coat_probability(std::abs(wo.z));
    Vec3 wi;
    if (u < coat) {
        if (Microfacets::is_smooth(alpha_x, alpha_y)) {
            return BsdfSample{{-wo.x, -wo.y, wo.z}, Rgb(fresnel_dielectric(std::abs(wo.z), ior)), coat, true};
        }
        const Vec3 m = Microfacets(alpha_x, alpha_y).sample_visible(wo, u2);
        wi = m * (2 * dot(wo, m)) - wo;
    } else {
        wi = to_cosine_hemisphere(u2);
        wi.z = wo.z < 0 ? -wi.z : wi.z;
    }
    const float p = density(wo, wi);
    if (!(p > 0)) {
        return std::nullopt;
    }
    return BsdfSample{wi, evaluate(wo, wi), p};
}

}  // namespace wend
