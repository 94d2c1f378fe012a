#include <wend/integrator/scattering.h>

namespace wend {

AxialLobes SurfaceScattering::lobes() const {
    if (!std::holds_alternative<LambertBsdf>(bsdf_)) {
        return AxialLobes();
    }
    return AxialLobes::cosine().around(wo_.z < 0 ? -shading_.n : shading_.n);
}

}  // namespace wend
