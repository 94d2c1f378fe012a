#include <wend/scene/noise.h>

#include <array>
#include <cmath>
#include <cstddef>
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

namespace {

constexpr float lacunarity = 1.99f;  // not 2: the zeros of the octaves do not coincide

template <class Term>
float sum_over(const Octaves& octaves, const Vec3& p, const Term& term, float& next_height) {
    float sum = 0, frequency = 1, height = 1;
    for (int i = 0; i < octaves.count; ++i) {
        sum += height * term(perlin_noise(p * frequency));
        frequency *= lacunarity;
        height *= octaves.falloff;
    }
    next_height = height;
    return sum;
}

}  // namespace

float fractal_noise(const Vec3& p, const Octaves& octaves) {
    float ignored = 0;
    return sum_over(
        octaves, p, [](float noise) { return noise; }, ignored);
}

float turbulence(const Vec3& p, const Octaves& octaves) {
    constexpr float mean_magnitude = 0.2f;
    float height = 0;
    const float sum = sum_over(
        octaves, p, [](float noise) { return std::abs(noise); }, height);
    return sum + mean_magnitude * height;
}

}  // namespace wend
