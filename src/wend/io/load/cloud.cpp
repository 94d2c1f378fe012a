#include <wend/core/parallel.h>
#include <wend/io/load/cloud.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace wend {
namespace {

// perlin2002's permutation of 0 ... 255.
constexpr std::array<std::uint8_t, 256> permutation = {
    151, 160, 137, 91,  90,  15,  131, 13,  201, 95,  96,  53,  194, 233, 7,   225, 140, 36,  103, 30,  69,  142,
    8,   99,  37,  240, 21,  10,  23,  190, 6,   148, 247, 120, 234, 75,  0,   26,  197, 62,  94,  252, 219, 203,
    117, 35,  11,  32,  57,  177, 33,  88,  237, 149, 56,  87,  174, 20,  125, 136, 171, 168, 68,  175, 74,  165,
    71,  134, 139, 48,  27,  166, 77,  146, 158, 231, 83,  111, 229, 122, 60,  211, 133, 230, 220, 105, 92,  41,
    55,  46,  245, 40,  244, 102, 143, 54,  65,  25,  63,  161, 1,   216, 80,  73,  209, 76,  132, 187, 208, 89,
    18,  169, 200, 196, 135, 130, 116, 188, 159, 86,  164, 100, 109, 198, 173, 186, 3,   64,  52,  217, 226, 250,
    124, 123, 5,   202, 38,  147, 118, 126, 255, 82,  85,  212, 207, 206, 59,  227, 47,  16,  58,  17,  182, 189,
    28,  42,  223, 183, 170, 213, 119, 248, 152, 2,   44,  154, 163, 70,  221, 153, 101, 155, 167, 43,  172, 9,
    129, 22,  39,  253, 19,  98,  108, 110, 79,  113, 224, 232, 178, 185, 112, 104, 218, 246, 97,  228, 251, 34,
    242, 193, 238, 210, 144, 12,  191, 179, 162, 241, 81,  51,  145, 235, 249, 14,  239, 107, 49,  192, 214, 31,
    181, 199, 106, 157, 184, 84,  204, 176, 115, 121, 50,  45,  127, 4,   150, 254, 138, 236, 205, 93,  222, 114,
    67,  29,  24,  72,  243, 141, 128, 195, 78,  66,  215, 61,  156, 180};

// The middles of a cube's edges; four of them twice, so that a mask chooses.
constexpr std::array<std::array<float, 3>, 16> gradients = {{{1, 1, 0},
                                                             {-1, 1, 0},
                                                             {1, -1, 0},
                                                             {-1, -1, 0},
                                                             {1, 0, 1},
                                                             {-1, 0, 1},
                                                             {1, 0, -1},
                                                             {-1, 0, -1},
                                                             {0, 1, 1},
                                                             {0, -1, 1},
                                                             {0, 1, -1},
                                                             {0, -1, -1},
                                                             {1, 1, 0},
                                                             {-1, 1, 0},
                                                             {0, 1, -1},
                                                             {0, -1, -1}}};

float slope(int x, int y, int z, const Vec3& offset) {
    const auto permuted = [](int i) { return static_cast<int>(permutation[static_cast<std::size_t>(i & 255)]); };
    const auto& g = gradients[static_cast<std::size_t>(permuted(permuted(permuted(x) + y) + z) & 15)];
    return g[0] * offset.x + g[1] * offset.y + g[2] * offset.z;
}

float smooth(float t) {
    return t * t * t * (t * (t * 6 - 15) + 10);
}

/// Differences of the noise over a small step.
Vec3 noise_gradient(const Vec3& p) {
    constexpr float step = 0.01f;
    const float n = perlin_noise(p);
    return Vec3(perlin_noise(p + Vec3(step, 0, 0)) - n, perlin_noise(p + Vec3(0, step, 0)) - n,
                perlin_noise(p + Vec3(0, 0, step)) - n) /
           step;
}

}  // namespace

float perlin_noise(const Vec3& p) {
    // Beyond, floats hold no fractions, and the noise is 0.
    constexpr float no_fractions = 1 << 23;
    if (!(std::abs(p.x) < no_fractions && std::abs(p.y) < no_fractions && std::abs(p.z) < no_fractions)) {
        return 0;
    }
    const Vec3 corner(std::floor(p.x), std::floor(p.y), std::floor(p.z));
    const Vec3 d = p - corner;
    const int x = static_cast<int>(corner.x), y = static_cast<int>(corner.y), z = static_cast<int>(corner.z);
    const float wx = smooth(d.x);
    const auto along_x = [&](int j, int k) {
        const float low = slope(x, y + j, z + k, d - Vec3(0, static_cast<float>(j), static_cast<float>(k)));
        const float high = slope(x + 1, y + j, z + k, d - Vec3(1, static_cast<float>(j), static_cast<float>(k)));
        return low + wx * (high - low);
    };
    const float wy = smooth(d.y);
    const auto face = [&](int k) {
        const float low = along_x(0, k);
        return low + wy * (along_x(1, k) - low);
    };
    const float low = face(0);
    return low + smooth(d.z) * (face(1) - low);
}

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
