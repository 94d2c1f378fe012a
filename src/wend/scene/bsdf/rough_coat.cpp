#include <wend/scene/bsdf/rough_coat.h>

#include <wend/sampling/warp.h>

#include <cmath>

namespace wend {

float rough_coat_return(const DielectricBsdf& coat, float thickness) {
    if (coat.is_specular()) {
        return coat_return(coat.ior, thickness);
    }
    constexpr int directions = 128, facets = 128;
    // Spread evenly, and no grid.
    constexpr double golden = 0.6180339887498949, silver = 0.4142135623730951;
    const auto part = [](double x) { return static_cast<float>(x - std::floor(x)); };
    double sum = 0;
    for (int i = 0; i < directions; ++i) {
        // By projected area, from below.
        const Vec3 up = to_cosine_hemisphere({(static_cast<float>(i) + 0.5f) / directions, part((i + 0.5) * golden)});
        const float before = std::exp(-thickness / up.z);
        for (int k = 0; k < facets; ++k) {
            const Vec2 u((static_cast<float>(k) + 0.5f) / facets, part((k + 0.5) * golden + i * silver));
            if (const auto s = coat.sample_reflection(-up, u)) {
                const float after = std::exp(-thickness / std::abs(s->direction.z));
                sum += static_cast<double>(before * after * s->value.r / s->density);
            }
        }
    }
    return static_cast<float>(sum / (directions * facets));
}

}  // namespace wend
