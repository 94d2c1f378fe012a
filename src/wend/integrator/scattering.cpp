#include <wend/integrator/scattering.h>

#include <array>

namespace wend {

AxialLobes SurfaceScattering::lobes() const {
    if (!std::holds_alternative<LambertBsdf>(bsdf_)) {
        return AxialLobes();
    }
    // The clamped cosine as a single lobe: the least-squares fit's concentration (ruppert2020).
    static const AxialLobes cosine(std::array{AxialLobe{1, 2.18853f}});
    return cosine.around(wo_.z < 0 ? -shading_.n : shading_.n);
}

}  // namespace wend
