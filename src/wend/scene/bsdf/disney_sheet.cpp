#include <wend/medium/fresnel.h>
#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/bsdf/disney_terms.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// To where a mirror would have reflected it.
Vec3 unfolded(const Vec3& wo, const Vec3& wi) {
    return {wi.x, wi.y, wo.z < 0 ? -std::abs(wi.z) : std::abs(wi.z)};
}

/// Of facets as seen from above, whichever side wo is on. What passes is seen through them as in a mirror: so the two
/// directions can be exchanged.
Vec3 half_vector(const Vec3& wo, const Vec3& wi) {
    const Vec3 m = normalize(wo + unfolded(wo, wi));
    return m.z < 0 ? -m : m;
}

}  // namespace

DisneySheetBsdf::Shares DisneySheetBsdf::shares(const Vec3& wo) const {
    constexpr float least = 0.2f;
    const float reflected = std::clamp(fresnel_dielectric(std::abs(wo.z), ior), least, 1 - least);
    return {spec_trans * reflected, spec_trans * (1 - reflected), (1 - spec_trans) * (1 - diff_trans)};
}

Rgb DisneySheetBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    if (wo.z == 0 || wi.z == 0) {
        return Rgb(0.0f);
    }
    const bool passes = wo.z * wi.z < 0;
    const Vec3 m = half_vector(wo, wi);
    const float cos_o = std::abs(wo.z), cos_i = std::abs(wi.z), half = abs_dot(wo, m);
    Rgb value(0.0f);
    if (spec_trans > 0) {
        const Microfacets of = facets(passes);
        // Each direction is masked by itself.
        const float single = spec_trans * of.d(m) * of.g1(wo) * of.g1(wi) / (4 * cos_o);
        const float fresnel = fresnel_dielectric(half, ior);
        const float grazing = schlick_weight(ior > 1 ? half : safe_sqrt(1 - (1 - sqr(half)) / sqr(ior)));
        const Rgb tinted = schlick(hue_of(base) * sqr((ior - 1) / (ior + 1)), grazing);
        value = (passes ? base * (1 - fresnel) : Rgb(fresnel * (1 - spec_tint)) + tinted * spec_tint) * single;
    }
    if (passes) {
        return value + base * ((1 - spec_trans) * diff_trans * inv_pi * cos_i);
    }
    const Rgb matt = base * (inv_pi * matt_value(roughness, flatness, cos_o, cos_i, half)) +
                     cloth_value(base, sheen, sheen_tint, half);
    return value + matt * ((1 - spec_trans) * (1 - diff_trans) * cos_i);
}

float DisneySheetBsdf::density(const Vec3& wo, const Vec3& wi) const {
    if (wo.z == 0 || wi.z == 0) {
        return 0;
    }
    const bool passes = wo.z * wi.z < 0;
    const Shares share = shares(wo);
    const float passed_diffusely = (1 - spec_trans) * diff_trans;
    const float even = (passes ? passed_diffusely : share.diffuse) * cosine_hemisphere_density(std::abs(wi.z));
    const Vec3 m = half_vector(wo, wi);
    if (!(spec_trans > 0)) {
        return even;
    }
    return even +
           (passes ? share.passed : share.mirrored) * facets(passes).visible_density(wo, m) / (4 * abs_dot(wo, m));
}

std::optional<BsdfSample> DisneySheetBsdf::sample(const Vec3& wo, float u, const Vec2& u2) const {
    if (wo.z == 0) {
        return std::nullopt;
    }
    const Shares share = shares(wo);
    Vec3 wi;
    if (u < share.mirrored + share.passed) {
        const bool passes = u >= share.mirrored;
        const Vec3 m = facets(passes).sample_visible(wo, u2);
        wi = m * (2 * dot(wo, m)) - wo;
        if (!(wo.z * wi.z > 0)) {
            return std::nullopt;
        }
        wi.z = passes ? -wi.z : wi.z;
    } else {
        wi = to_cosine_hemisphere(u2);
        const bool goes_up = (u < share.mirrored + share.passed + share.diffuse) == (wo.z > 0);
        wi.z = goes_up ? wi.z : -wi.z;
    }
    const float p = density(wo, wi);
    return p > 0 ? std::optional(BsdfSample{wi, evaluate(wo, wi), p}) : std::nullopt;
}

}  // namespace wend
