// Reflection and refraction at a smooth boundary. Directions are local: z is the normal.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/vector.h>

#include <complex>
#include <concepts>
#include <optional>

namespace wend {

/// Unpolarized reflectance of a smooth dielectric; `cosine` is signed (positive: outside), `ior` = inside over outside.
template <std::floating_point T>
T fresnel_dielectric(T cosine, T ior) {
    cosine = std::clamp(cosine, T(-1), T(1));
    if (cosine < 0) {
        ior = 1 / ior;
        cosine = -cosine;
    }
    const T sin2_t = (1 - cosine * cosine) / (ior * ior);
    if (sin2_t >= 1) {
        return 1;
    }
    const T cosine_t = std::sqrt(1 - sin2_t);
    const T parallel = (ior * cosine - cosine_t) / (ior * cosine + cosine_t);
    const T perpendicular = (cosine - ior * cosine_t) / (cosine + ior * cosine_t);
    return T(0.5) * (parallel * parallel + perpendicular * perpendicular);
}

/// Reflectance of a smooth conductor with complex index eta + i k relative to the outside; cosine >= 0.
inline float fresnel_conductor(float cosine, float eta, float k) {
    using Complex = std::complex<float>;
    cosine = std::clamp(cosine, 0.0f, 1.0f);
    const Complex n(eta, k);
    const Complex sin2_t = (1 - cosine * cosine) / (n * n);
    const Complex cosine_t = std::sqrt(Complex(1) - sin2_t);
    const Complex parallel = (n * cosine - cosine_t) / (n * cosine + cosine_t);
    const Complex perpendicular = (cosine - n * cosine_t) / (cosine + n * cosine_t);
    return 0.5f * (std::norm(parallel) + std::norm(perpendicular));
}

/// A refracted direction and the ratio of the indices on its far side and near side.
struct Refraction {
    Vec3 direction;
    float ior;
};

/// Refracts w (pointing away from the surface) about the unit normal n; none where it is totally reflected. `ior` = the
/// index on the side that -n points to over that on n's side.
inline std::optional<Refraction> refract(const Vec3& w, Vec3 n, float ior) {
    float cosine = dot(n, w);
    if (cosine < 0) {
        ior = 1 / ior;
        cosine = -cosine;
        n = -n;
    }
    const float sin2_t = std::max(0.0f, 1 - cosine * cosine) / (ior * ior);
    if (sin2_t >= 1) {
        return std::nullopt;
    }
    return Refraction{-w / ior + n * (cosine / ior - safe_sqrt(1 - sin2_t)), ior};
}

/// Hemispherical average of fresnel_dielectric for light that arrives from outside (cosine-weighted).
float fresnel_diffuse_reflectance(float ior);

}  // namespace wend
