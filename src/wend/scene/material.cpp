#include <wend/core/contracts.h>
#include <wend/scene/material.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

Rgb clamp01(const Rgb& c) {
    return {std::clamp(c.r, 0.0f, 1.0f), std::clamp(c.g, 0.0f, 1.0f), std::clamp(c.b, 0.0f, 1.0f)};
}

struct Alpha {
    float x, y;
};

Alpha alpha_at(const Roughness& roughness, const Textures& textures, const TexturePoint& p) {
    const auto one = [&](TextureId id) {
        const float r = std::clamp(textures.evaluate_grey(id, p), 0.0f, 1.0f);
        return roughness.remap ? std::sqrt(r) : r;
    };
    return {one(roughness.u), one(roughness.v)};
}

Bsdf bsdf_of(const DiffuseMaterial& m, const Textures& textures, const TexturePoint& p) {
    return LambertBsdf{clamp01(textures.evaluate(m.reflectance, p))};
}

Bsdf bsdf_of(const ConductorMaterial& m, const Textures& textures, const TexturePoint& p) {
    const Alpha alpha = alpha_at(m.roughness, textures, p);
    if (m.reflectance < 0) {
        return ConductorBsdf{textures.evaluate(m.eta, p), textures.evaluate(m.k, p), alpha.x, alpha.y};
    }
    // With eta = 1 the normal reflectance is k²/(4 + k²).
    Rgb k;
    const Rgb r = clamp01(textures.evaluate(m.reflectance, p));
    for (int c = 0; c < 3; ++c) {
        k[c] = 2 * std::sqrt(std::min(r[c], 0.9999f) / (1 - std::min(r[c], 0.9999f)));
    }
    return ConductorBsdf{Rgb(1.0f), k, alpha.x, alpha.y};
}

Bsdf bsdf_of(const DielectricMaterial& m, const Textures& textures, const TexturePoint& p) {
    const Alpha alpha = alpha_at(m.roughness, textures, p);
    return DielectricBsdf{m.ior, alpha.x, alpha.y};
}

Bsdf bsdf_of(const CoatedDiffuseMaterial& m, const Textures& textures, const TexturePoint& p) {
    const Alpha alpha = alpha_at(m.roughness, textures, p);
    return CoatedDiffuseBsdf{clamp01(textures.evaluate(m.reflectance, p)), m.ior, alpha.x, alpha.y,
                             m.inner_reflectance};
}

Bsdf bsdf_of(const InterfaceMaterial&, const Textures&, const TexturePoint&) {
    WEND_EXPECT(false);
    return LambertBsdf{};
}

}  // namespace

Bsdf make_bsdf(const Material& material, const Textures& textures, const TexturePoint& p) {
    return std::visit([&](const auto& m) { return bsdf_of(m, textures, p); }, material);
}

}  // namespace wend
