#include <wend/integrator/scattering.h>

namespace wend {

std::optional<Vmf> VolumeScattering::lobe() const {
    return Vmf::with_mean_cosine(before_, phase_.mean_cosine());
}

std::optional<Vmf> SurfaceScattering::lobe() const {
    // The clamped cosine as a single lobe: the least-squares fit's concentration (ruppert2020).
    constexpr float cosine_kappa = 2.18853f;
    if (!std::holds_alternative<LambertBsdf>(bsdf_)) {
        return std::nullopt;
    }
    return Vmf{wo_.z < 0 ? -shading_.n : shading_.n, cosine_kappa};
}

}  // namespace wend
