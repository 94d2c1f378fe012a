// Noise of lattices, and sums of it over scales.
#pragma once

#include <wend/core/vector.h>

namespace wend {

/// Gradient noise (perlin2002): smooth, in [-1, 1], zero at points of integer coordinates.
float perlin_noise(const Vec3& p);
/// In the plane z = 1/2, as pbrt has it for two dimensions.
inline float perlin_noise(float x, float y) {
    return perlin_noise(Vec3(x, y, 0.5f));
}

/// How noise is summed over octaves: each of 1.99 times the frequency and `falloff` times the height of the one before.
struct Octaves {
    int count = 8;
    float falloff = 0.5f;
};

/// The sum of noise over octaves ("fractional Brownian motion").
float fractal_noise(const Vec3& p, const Octaves& octaves);
/// The sum of the noise's magnitude, with the mean of one octave more.
float turbulence(const Vec3& p, const Octaves& octaves);

}  // namespace wend
