#include <wend/medium/fresnel.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/scene/bsdf/measured.h>

#include <cmath>

namespace wend {
namespace {

Rgb albedo(const LambertBsdf& b, const Vec3&) {
    return b.reflectance;
}
Rgb albedo(const ConductorBsdf& b, const Vec3& wo) {
    return b.reflectance(std::abs(wo.z));
}
Rgb albedo(const DielectricBsdf& b, const Vec3& wo) {
    return b.transmittance + (b.reflectance - b.transmittance) * b.reflected_share(wo.z);
}
Rgb albedo(const ThinDielectricBsdf& b, const Vec3& wo) {
    return b.transmittance + (b.reflectance - b.transmittance) * b.reflected_share(wo);
}
Rgb albedo(const DiffuseTransmissionBsdf& b, const Vec3&) {
    return b.reflectance + b.transmittance;
}
Rgb albedo(const CoatedBsdf& b, const Vec3& wo) {
    return b.reflectance_estimate(wo);
}
Rgb albedo(const HairBsdf& b, const Vec3& wo) {
    return b.albedo(wo);
}
Rgb albedo(const PrincipledBsdf& b, const Vec3& wo) {
    return b.albedo(wo);
}
Rgb albedo(const MeasuredBsdf& b, const Vec3& wo) {
    return b.tables->albedo(wo);
}
Rgb albedo(const DisneyBsdf& b, const Vec3& wo) {
    return b.albedo(wo);
}
Rgb albedo(const DisneySheetBsdf& b, const Vec3& wo) {
    const float fresnel = fresnel_dielectric(std::abs(wo.z), b.ior);
    return b.base * (1 - b.spec_trans * fresnel) + Rgb(b.spec_trans * fresnel);
}

}  // namespace

Rgb directional_albedo(const Bsdf& bsdf, const Vec3& wo) {
    return std::visit([&](const auto& b) { return albedo(b, wo); }, bsdf);
}

}  // namespace wend
