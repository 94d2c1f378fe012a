#include <wend/medium/fresnel.h>
#include <wend/scene/bsdf/bsdf.h>

#include <algorithm>
#include <cmath>
#include <numbers>

namespace wend {
namespace {

/// Logarithm of the modified Bessel function of the first kind, order 0; x >= 0.
float log_bessel_i0(float x) {
    // The series of e^-x sqrt(2 pi x) I0(x), below a relative error of 1e-4 from here on.
    constexpr float far = 12;
    if (x > far) {
        return x - 0.5f * std::log(2 * pi * x) + std::log1p((0.125f + 0.0703125f / x) / x);
    }
    return std::log(std::cyl_bessel_i(0.0f, x));
}

/// Density of the sine of the inclination, scattered along the fibre: by which cosine and sine it comes and goes.
float along(float cos_i, float cos_o, float sin_i, float sin_o, float variance) {
    const float a = cos_i * cos_o / variance, b = sin_i * sin_o / variance;
    // log(2 v sinh(1/v)), which overflows as it stands.
    const float norm = 1 / variance + std::log(variance) + std::log1p(-std::exp(-2 / variance));
    return std::exp(log_bessel_i0(a) - b - norm);
}

float logistic_cdf(float x, float scale) {
    return 1 / (1 + std::exp(-x / scale));
}

/// Of the logistic distribution, cut off at ±pi.
float trimmed_logistic(float x, float scale) {
    const float e = std::exp(-std::abs(x) / scale);
    return e / (scale * sqr(1 + e)) / (2 * logistic_cdf(pi, scale) - 1);
}

float sample_trimmed_logistic(float u, float scale) {
    const float low = logistic_cdf(-pi, scale);
    const float x = -scale * std::log(1 / (low + u * (1 - 2 * low)) - 1);
    return std::clamp(x, -pi, pi);
}

float to_half_turns(float phi) {
    return phi - 2 * pi * std::round(phi / (2 * pi));
}

float safe_asin(float x) {
    return std::asin(std::clamp(x, -1.0f, 1.0f));
}

float fifth(float x) {
    return sqr(sqr(x)) * x;
}

}  // namespace

/// What all directions of incidence have in common, given one.
struct HairBsdf::Fibre {
    float sin_o, cos_o, phi_o;
    float gamma_o, gamma_t;            ///< azimuth of where light enters, outside and inside, against the normal there
    std::array<Rgb, orders> share;     ///< of light, by how often it was reflected inside
    std::array<float, orders> chosen;  ///< probabilities

    Fibre(const HairBsdf& hair, const Vec3& wo);

    /// By how much an order turns light around the fibre, without roughness.
    float turn(int order) const {
        return 2 * static_cast<float>(order) * gamma_t - 2 * gamma_o + static_cast<float>(order) * pi;
    }

    /// Sine and cosine of the inclination of wo against an order's scales.
    std::pair<float, float> tilted(const HairBsdf& hair, int order) const {
        if (order >= 3) {
            return {sin_o, std::abs(cos_o)};
        }
        const auto k = static_cast<std::size_t>(order == 0 ? 1 : order == 1 ? 0 : 2);
        const float s = order == 0 ? -hair.sin_tilt_[k] : hair.sin_tilt_[k], c = hair.cos_tilt_[k];
        return {sin_o * c + cos_o * s, std::abs(cos_o * c - sin_o * s)};
    }

    /// Density of an order at a direction.
    float density(const HairBsdf& hair, int order, const Vec3& wi) const {
        const auto [sin, cos] = tilted(hair, order);
        const float m =
            along(safe_sqrt(1 - sqr(wi.x)), cos, wi.x, sin, hair.variance_[static_cast<std::size_t>(order)]);
        if (order == orders - 1) {
            return m / (2 * pi);
        }
        const float phi = std::atan2(wi.z, wi.y) - phi_o;
        return m * trimmed_logistic(to_half_turns(phi - turn(order)), hair.scale_);
    }
};

HairBsdf::Fibre::Fibre(const HairBsdf& hair, const Vec3& wo)
    : sin_o(wo.x), cos_o(safe_sqrt(1 - sqr(wo.x))), phi_o(std::atan2(wo.z, wo.y)), gamma_o(safe_asin(hair.offset_)) {
    // The index that the section across the fibre sees.
    const float section = std::sqrt(std::max(sqr(hair.ior_) - sqr(sin_o), 1e-6f)) / std::max(cos_o, 1e-4f);
    gamma_t = safe_asin(hair.offset_ / section);
    const float cos_t = std::max(safe_sqrt(1 - sqr(sin_o / hair.ior_)), 1e-4f);
    const float way = 2 * std::cos(gamma_t) / cos_t;
    const float f = fresnel_dielectric(cos_o * safe_sqrt(1 - sqr(hair.offset_)), hair.ior_);
    float total = 0;
    for (int c = 0; c < 3; ++c) {
        const float passed = std::exp(-hair.absorption_[c] * way);
        share[0][c] = f;
        share[1][c] = sqr(1 - f) * passed;
        share[2][c] = share[1][c] * passed * f;
        share[3][c] = f * passed < 1 ? share[2][c] * f * passed / (1 - f * passed) : 0.0f;
    }
    for (std::size_t p = 0; p < orders; ++p) {
        chosen[p] = mean_value(share[p]);
        total += chosen[p];
    }
    for (float& p : chosen) {
        p /= total;
    }
}

HairBsdf::HairBsdf(float offset, float ior, const Rgb& absorption, float roughness_along, float roughness_across,
                   float tilt)
    : offset_(std::clamp(offset, -1.0f, 1.0f)), ior_(ior), absorption_(absorption) {
    // Fits of chiang2016 to what artists see as even steps.
    const float m = std::clamp(roughness_along, 0.01f, 1.0f), n = std::clamp(roughness_across, 0.01f, 1.0f);
    const float m20 = sqr(sqr(fifth(m))), n22 = sqr(sqr(fifth(n)) * n);
    variance_[0] = sqr(0.726f * m + 0.812f * m * m + 3.7f * m20);
    variance_[1] = 0.25f * variance_[0];
    variance_[2] = variance_[3] = 4 * variance_[0];
    scale_ = std::sqrt(pi / 8) * (0.265f * n + 1.194f * n * n + 5.372f * n22);
    for (std::size_t k = 0; k < 3; ++k) {
        const float angle = tilt * static_cast<float>(1 << k);
        sin_tilt_[k] = std::sin(angle);
        cos_tilt_[k] = std::cos(angle);
    }
}

Rgb HairBsdf::evaluate(const Vec3& wo, const Vec3& wi) const {
    const Fibre fibre(*this, wo);
    Rgb sum(0.0f);
    for (int p = 0; p < orders; ++p) {
        sum += fibre.share[static_cast<std::size_t>(p)] * fibre.density(*this, p, wi);
    }
    return sum;
}

float HairBsdf::density(const Vec3& wo, const Vec3& wi) const {
    const Fibre fibre(*this, wo);
    float sum = 0;
    for (int p = 0; p < orders; ++p) {
        sum += fibre.chosen[static_cast<std::size_t>(p)] * fibre.density(*this, p, wi);
    }
    return sum;
}

std::optional<BsdfSample> HairBsdf::sample(const Vec3& wo, float u, const Vec2& u2) const {
    const Fibre fibre(*this, wo);
    int order = 0;
    while (order < orders - 1 && u >= fibre.chosen[static_cast<std::size_t>(order)]) {
        u -= fibre.chosen[static_cast<std::size_t>(order++)];
    }
    const auto p = static_cast<std::size_t>(order);
    const float rest = fibre.chosen[p] > 0 ? std::clamp(u / fibre.chosen[p], 0.0f, 1 - 0x1p-24f) : 0.5f;
    // Inclination (deon2013), then azimuth.
    const auto [sin, cos] = fibre.tilted(*this, order);
    const float v = variance_[p];
    const float x = std::max(u2.x, 1e-5f);
    const float c = 1 + v * std::log(x + (1 - x) * std::exp(-2 / v));
    const float sin_i = std::clamp(-c * sin + safe_sqrt(1 - c * c) * std::cos(2 * pi * u2.y) * cos, -1.0f, 1.0f);
    const float cos_i = safe_sqrt(1 - sqr(sin_i));
    const float turn = order == orders - 1 ? 2 * pi * rest : fibre.turn(order) + sample_trimmed_logistic(rest, scale_);
    const float phi = fibre.phi_o + turn;
    const Vec3 wi(sin_i, cos_i * std::cos(phi), cos_i * std::sin(phi));
    const float density_of_it = density(wo, wi);
    return density_of_it > 0 && std::isfinite(density_of_it)
               ? std::optional(BsdfSample{wi, evaluate(wo, wi), density_of_it})
               : std::nullopt;
}

Rgb HairBsdf::albedo(const Vec3& wo) const {
    const Fibre fibre(*this, wo);
    return fibre.share[0] + fibre.share[1] + fibre.share[2] + fibre.share[3];
}

}  // namespace wend
