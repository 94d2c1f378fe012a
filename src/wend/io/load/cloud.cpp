#include <wend/io/load/cloud.h>

#include <wend/core/parallel.h>
#include <wend/scene/noise.h>

#include <algorithm>

namespace wend {
namespace {

/// Differences of the noise over a small step.
Vec3 noise_gradient(const Vec3& p) {
    constexpr float step = 0.01f;
    const float n = perlin_noise(p);
    return Vec3(perlin_noise(p + Vec3(step, 0, 0)) - n, perlin_noise(p + Vec3(0, step, 0)) - n,
                perlin_noise(p + Vec3(0, 0, step)) - n) /
           step;
}

}  // namespace

float cloud_density(const CloudShape& shape, const Vec3& p) {
    // Not quite 2, so that the lattices of two octaves do not coincide.
    constexpr float octave = 1.99f;
    Vec3 q = p * shape.frequency;
    if (shape.wispiness > 0) {
        float strength = 0.05f * shape.wispiness;
        float frequency = 10;
        for (int i = 0; i < 2; ++i) {
            q += noise_gradient(q * frequency) * strength;
            strength *= 0.5f;
            frequency *= octave;
        }
    }
    float lumps = 0;
    float strength = 0.5f;
    float frequency = 1;
    for (int i = 0; i < 5; ++i) {
        lumps += strength * perlin_noise(q * frequency);
        strength *= 0.5f;
        frequency *= octave;
    }
    const float thinning = std::clamp((1 - p.y) * 4.5f * shape.density * lumps, 0.0f, 1.0f);
    return std::clamp(thinning + 2 * std::max(0.0f, 0.5f - p.y), 0.0f, 1.0f);
}

Grid bake_cloud(const CloudShape& shape, const Box3& box, int cells) {
    const auto side = static_cast<std::size_t>(cells) + 1;
    std::vector<float> values(side * side * side);
    const Vec3 step = box.size() / static_cast<float>(cells);
    parallel_for(side, 0, [&](std::size_t z) {
        for (std::size_t y = 0; y < side; ++y) {
            for (std::size_t x = 0; x < side; ++x) {
                const Vec3 i(static_cast<float>(x), static_cast<float>(y), static_cast<float>(z));
                values[(z * side + y) * side + x] = cloud_density(shape, box.min + step * i);
            }
        }
    });
    const auto value = [&](int x, int y, int z) {
        return values[(static_cast<std::size_t>(z) * side + static_cast<std::size_t>(y)) * side +
                      static_cast<std::size_t>(x)];
    };
    const auto size = static_cast<int>(side);
    return Grid(
        {0, 0, 0}, {size, size, size}, [](const Vec3i&, const Vec3i&) { return true; }, value);
}

}  // namespace wend
