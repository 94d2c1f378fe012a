#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>

namespace wend {

Rgb LambertBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    return wo.z * wi.z > 0 ? reflectance * (inv_pi * std::abs(wi.z)) : Rgb(0.0f);
}

float LambertBsdf::density(const Vec3& wo, const Vec3& wi) const {
    return wo.z * wi.z > 0 ? cosine_hemisphere_density(std::abs(wi.z)) : 0.0f;
}

std::optional<BsdfSample> LambertBsdf::sample(const Vec3& wo, float, const Vec2& u2) const {
    Vec3 wi = to_cosine_hemisphere(u2);
    if (wo.z < 0) {
        wi.z = -wi.z;
    }
    const float p = density(wo, wi);
    if (!(p > 0)) {
        return std::nullopt;
    }
    return BsdfSample{wi, evaluate(wo, wi), p};
}

}  // namespace wend
