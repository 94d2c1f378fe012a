#include <wend/medium/fresnel.h>
#include <wend/scene/bsdf/bsdf.h>

namespace wend {

float ThinDielectricBsdf::reflected_share(const Vec3& wo) const {
    // r + t² r (1 + r² + r⁴ ...) of the two faces, with t = 1 - r.
    const float r = fresnel_dielectric(std::abs(wo.z), ior);
    return 2 * r / (1 + r);
}

std::optional<BsdfSample> ThinDielectricBsdf::sample(const Vec3& wo, float u, const Vec2&) const {
    const float reflected = reflected_share(wo);
    if (u < reflected) {
        return BsdfSample{{-wo.x, -wo.y, wo.z}, reflectance * reflected, reflected, true};
    }
    return BsdfSample{-wo, transmittance * (1 - reflected), 1 - reflected, true};
}

}  // namespace wend
