#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>

namespace wend {

float DiffuseTransmissionBsdf::reflection_probability() const {
    const float reflected = max_value(reflectance), transmitted = max_value(transmittance);
    return reflected + transmitted > 0 ? reflected / (reflected + transmitted) : 0.5f;
}

Rgb DiffuseTransmissionBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    return (wo.z * wi.z > 0 ? reflectance : transmittance) * (inv_pi * std::abs(wi.z));
}

float DiffuseTransmissionBsdf::density(const Vec3& wo, const Vec3& wi) const {
    const float reflection = reflection_probability();
    return (wo.z * wi.z > 0 ? reflection : 1 - reflection) * cosine_hemisphere_density(std::abs(wi.z));
}

std::optional<BsdfSample> DiffuseTransmissionBsdf::sample(const Vec3& wo, float u, const Vec2& u2) const {
    Vec3 wi = to_cosine_hemisphere(u2);
    const bool goes_up = (u < reflection_probability()) == (wo.z > 0);
    wi.z = goes_up ? wi.z : -wi.z;
    const float p = density(wo, wi);
    return p > 0 ? std::optional(BsdfSample{wi, evaluate(wo, wi), p}) : std::nullopt;
}

}  // namespace wend
