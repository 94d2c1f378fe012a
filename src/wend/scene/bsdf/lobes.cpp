// What BSDFs look like to a guide.
#include <wend/sampling/vmf.h>
#include <wend/scene/bsdf/bsdf.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

/// On the side of wo.
AxialLobes cosine_lobes(const Vec3& wo) {
    return AxialLobes::cosine().around({0, 0, wo.z < 0 ? -1.0f : 1.0f});
}

/// On both sides, by the shares that are drawn.
AxialLobes two_sided_lobes(const DiffuseTransmissionBsdf& b, const Vec3& wo) {
    const float kappa = AxialLobes::cosine().kappa(0), reflected = b.reflection_probability();
    const std::array<AxialLobe, 2> lobes = {AxialLobe{reflected, kappa}, AxialLobe{1 - reflected, -kappa}};
    return AxialLobes(lobes).around({0, 0, wo.z < 0 ? -1.0f : 1.0f});
}

/// GGX facets tilted by an angle t have the density (1 + x)^(-2) with x = tan² t / alpha². They reflect by twice the
/// angle, in the plane of incidence; across it by less, as the cosine of incidence. So around the mirror direction, at
/// an angle of cosine c, x is about (1 - c) / (2 alpha² cosine), and
///     (1 + x)^(-2) ≈ Σ amplitude_j exp(-rate_j x)
/// within 1.042 either way up to x = 100 (least largest |log ratio|); each term is a lobe.
AxialLobes mirror_lobes(float alpha_x, float alpha_y, const Vec3& wo) {
    constexpr int count = 4;
    constexpr std::array<float, count> amplitude = {0.74361f, 0.20443f, 0.01907f, 0.00121f};
    constexpr std::array<float, count> rate = {1.94473f, 0.49366f, 0.12333f, 0.02554f};
    constexpr float least_cosine = 0.1f;
    const float unit = 1 / (2 * alpha_x * alpha_y * std::max(std::abs(wo.z), least_cosine));
    std::array<AxialLobe, count> lobes;
    for (int j = 0; j < count; ++j) {
        const float kappa = std::min(rate[j] * unit, Vmf::max_kappa);
        lobes[j] = {amplitude[j] / vmf_peak(kappa), kappa};
    }
    return AxialLobes(lobes).around({-wo.x, -wo.y, wo.z});
}

AxialLobes mirror_lobes(const ConductorBsdf& b, const Vec3& wo) {
    return mirror_lobes(b.alpha_x, b.alpha_y, wo);
}

struct LobesOf {
    const Vec3& wo;

    AxialLobes operator()(const LambertBsdf&) const { return cosine_lobes(wo); }
    AxialLobes operator()(const DiffuseTransmissionBsdf& b) const { return two_sided_lobes(b, wo); }
    // The coat of a diffuse base is left to the BSDF's own sampling.
    AxialLobes operator()(const CoatedBsdf& b) const {
        return std::holds_alternative<LambertBsdf>(b.base) ? cosine_lobes(wo)
               : b.is_specular()                           ? AxialLobes()
                                                           : mirror_lobes(b.seen_base(), wo);
    }
    AxialLobes operator()(const ConductorBsdf& b) const { return b.is_specular() ? AxialLobes() : mirror_lobes(b, wo); }
    AxialLobes operator()(const DielectricBsdf&) const { return {}; }
    AxialLobes operator()(const ThinDielectricBsdf&) const { return {}; }
    AxialLobes operator()(const HairBsdf&) const { return {}; }
    AxialLobes operator()(const MeasuredBsdf&) const { return {}; }
    // The facets of a dielectric are left to the BSDF's own sampling.
    AxialLobes operator()(const PrincipledBsdf& b) const {
        constexpr float half = 0.5f;
        if (b.has_inside) {
            return {};
        }
        return b.metallic < half ? cosine_lobes(wo) : mirror_lobes(b.alpha, b.alpha, wo);
    }
    // The same; what passes has no lobes.
    AxialLobes operator()(const DisneyBsdf& b) const {
        constexpr float half = 0.5f;
        if (b.spec_trans > 0) {
            return {};
        }
        return b.metallic < half ? cosine_lobes(wo) : mirror_lobes(b.alpha_x, b.alpha_y, wo);
    }
    AxialLobes operator()(const DisneySheetBsdf& b) const {
        return b.spec_trans > 0 ? AxialLobes()
                                : two_sided_lobes({b.base * (1 - b.diff_trans), b.base * b.diff_trans}, wo);
    }
};

}  // namespace

AxialLobes lobes_of(const Bsdf& bsdf, const Vec3& wo) {
    return std::visit(LobesOf{wo}, bsdf);
}

bool is_pictured_by_lobes(const Bsdf& bsdf) {
    struct Pictured {
        bool operator()(const LambertBsdf&) const { return true; }
        bool operator()(const DiffuseTransmissionBsdf&) const { return true; }
        bool operator()(const ConductorBsdf& b) const { return !b.is_specular(); }
        bool operator()(const DielectricBsdf&) const { return false; }
        bool operator()(const ThinDielectricBsdf&) const { return false; }
        bool operator()(const CoatedBsdf& b) const { return !b.is_specular(); }
        bool operator()(const HairBsdf&) const { return false; }
        bool operator()(const MeasuredBsdf&) const { return false; }
        bool operator()(const PrincipledBsdf& b) const { return !b.has_inside; }
        bool operator()(const DisneyBsdf& b) const { return !(b.spec_trans > 0); }
        bool operator()(const DisneySheetBsdf& b) const { return !(b.spec_trans > 0); }
    };
    return std::visit(Pictured{}, bsdf);
}

}  // namespace wend
