#include <wend/io/load/forced_diffuse.h>

#include <wend/sampling/warp.h>
#include <wend/scene/bsdf/bsdf.h>

#include <variant>

namespace wend {
namespace {

/// The share of light, even from above, that is scattered.
Rgb hemispherical_albedo(const Bsdf& bsdf) {
    constexpr int samples = 4096;
    Pcg32 random(1);
    Rgb sum(0.0f);
    for (int i = 0; i < samples; ++i) {
        const Vec3 wo = to_cosine_hemisphere(random.uniform2());
        const float u = random.uniform();
        const Vec2 u2 = random.uniform2();
        if (const auto s = std::visit([&](const auto& b) { return b.sample(wo, u, u2); }, bsdf)) {
            sum += s->value / s->density;
        }
    }
    return sum / samples;
}

}  // namespace

void force_diffuse(std::vector<LoadedMaterial>& materials, Textures& textures) {
    for (LoadedMaterial& loaded : materials) {
        loaded.inside.reset();
        loaded.detail = {};
        const Material& material = loaded.material;
        if (!std::holds_alternative<InterfaceMaterial>(material) && !std::holds_alternative<MixMaterial>(material) &&
            !std::holds_alternative<DiffuseMaterial>(material)) {
            loaded.material = DiffuseMaterial{
                textures.add_constant(hemispherical_albedo(make_bsdf(material, textures, {{0.5f, 0.5f}, {0, 0, 0}})))};
        }
    }
}

}  // namespace wend
