#include <wend/medium/fresnel.h>

namespace wend {

float fresnel_diffuse_reflectance(float ior) {
    // Midpoint rule in sin², where the cosine-weighted measure is uniform: smooth but for the critical angle, ample at
    // load time.
    constexpr int cells = 4096;
    double sum = 0;
    for (int i = 0; i < cells; ++i) {
        const float sin2 = (static_cast<float>(i) + 0.5f) / cells;
        sum += fresnel_dielectric(std::sqrt(1 - sin2), ior);
    }
    return static_cast<float>(sum / cells);
}

}  // namespace wend
