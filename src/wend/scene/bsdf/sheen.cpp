#include <wend/scene/bsdf/sheen.h>

#include <wend/sampling/warp.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

namespace wend {
namespace {

/// Uniform cubic B-splines in the roughness (rows) and in the root of the cosine (columns): a least-squares fit to the
/// tables of zeltner2022 as Cycles 5.0 has them, within 2e-3 of the albedo from a roughness of 0.3 up.
constexpr std::size_t spline_size = 8;
using Spline = std::array<std::array<float, spline_size>, spline_size>;

constexpr Spline spline_of_a = {{{0.004f, -0.009f, -0.052f, -0.135f, -0.102f, 0.074f, 0.312f, 0.543f},
                                 {0.051f, 0.036f, 0.064f, 0.073f, 0.071f, 0.16f, 0.346f, 0.551f},
                                 {0.125f, 0.076f, 0.107f, 0.242f, 0.285f, 0.301f, 0.398f, 0.577f},
                                 {0.243f, 0.188f, 0.24f, 0.337f, 0.43f, 0.468f, 0.533f, 0.651f},
                                 {0.42f, 0.324f, 0.392f, 0.504f, 0.585f, 0.649f, 0.692f, 0.745f},
                                 {0.619f, 0.535f, 0.597f, 0.696f, 0.748f, 0.78f, 0.807f, 0.831f},
                                 {0.768f, 0.724f, 0.761f, 0.829f, 0.863f, 0.882f, 0.88f, 0.893f},
                                 {0.859f, 0.831f, 0.846f, 0.889f, 0.913f, 0.928f, 0.943f, 0.955f}}};
constexpr Spline spline_of_b = {{{0.088f, 0.165f, 0.115f, -0.044f, -0.078f, -0.047f, -0.026f, -0.021f},
                                 {-0.143f, -0.234f, 0.029f, 0.031f, -0.06f, -0.03f, -0.03f, 0},
                                 {-0.106f, -0.205f, -0.194f, 0.019f, -0.001f, -0.039f, -0.049f, 0.039f},
                                 {-0.15f, -0.173f, -0.194f, -0.15f, -0.04f, -0.033f, -0.037f, 0.103f},
                                 {-0.164f, -0.155f, -0.165f, -0.141f, -0.117f, -0.067f, -0.037f, 0.163f},
                                 {-0.112f, -0.101f, -0.112f, -0.101f, -0.078f, -0.067f, -0.034f, 0.149f},
                                 {-0.01f, 0, 0.002f, -0.001f, -0.013f, -0.005f, -0.007f, 0.034f},
                                 {0.11f, 0.108f, 0.1f, 0.109f, 0.124f, 0.1f, 0.026f, -0.079f}}};
constexpr Spline spline_of_albedo = {{{0.645f, 0.267f, -0.537f, -0.294f, 0.272f, -0.092f, 0.022f, 0.011f},
                                      {0.373f, 0.857f, 0.568f, -0.117f, -0.032f, 0.012f, 0.004f, -0.027f},
                                      {0.458f, 0.758f, 0.643f, 0.358f, -0.008f, -0.002f, -0.007f, 0.033f},
                                      {0.54f, 0.752f, 0.64f, 0.483f, 0.245f, 0.03f, 0.007f, -0.026f},
                                      {0.567f, 0.729f, 0.669f, 0.562f, 0.376f, 0.19f, 0.05f, -0.013f},
                                      {0.62f, 0.748f, 0.69f, 0.621f, 0.493f, 0.323f, 0.19f, 0.076f},
                                      {0.697f, 0.764f, 0.741f, 0.676f, 0.567f, 0.445f, 0.342f, 0.25f},
                                      {0.797f, 0.79f, 0.76f, 0.723f, 0.643f, 0.53f, 0.477f, 0.442f}}};

/// The four control points around a place in [0, 1], and their weights.
struct Place {
    std::size_t first;
    std::array<float, 4> weight;

    explicit Place(float x) {
        const float at = std::clamp(x, 0.0f, 1.0f) * (spline_size - 3);
        first = std::min(static_cast<std::size_t>(at), spline_size - 4);
        const float t = at - static_cast<float>(first), s = 1 - t;
        weight = {s * s * s / 6, (4 + t * t * (3 * t - 6)) / 6, (4 + s * s * (3 * s - 6)) / 6, t * t * t / 6};
    }
};

float value_of(const Spline& spline, const Place& row, const Place& column) {
    float value = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        for (std::size_t j = 0; j < 4; ++j) {
            value += row.weight[i] * column.weight[j] * spline[row.first + i][column.first + j];
        }
    }
    return value;
}

}  // namespace

Sheen::Sheen(const Vec3& wo, float roughness) : side_(wo.z < 0 ? -1.0f : 1.0f) {
    constexpr float narrowest = 0.03f;
    const Place row((roughness - least_roughness) / (1 - least_roughness)), column(std::sqrt(std::abs(wo.z)));
    a_ = std::max(value_of(spline_of_a, row, column), narrowest);
    b_ = value_of(spline_of_b, row, column);
    albedo_ = std::clamp(value_of(spline_of_albedo, row, column), 0.0f, 1.0f);
    const Vec3 flat(wo.x, wo.y, 0);
    const float sine = length(flat);
    along_ = sine > 0 ? flat / sine : Vec3(1, 0, 0);
}

float Sheen::density(const Vec3& wi) const {
    const float x = along_.x * wi.x + along_.y * wi.y, y = along_.x * wi.y - along_.y * wi.x, z = side_ * wi.z;
    if (!(z > 0)) {
        return 0;
    }
    return inv_pi * z * sqr(a_ / (sqr(a_ * x + b_ * z) + sqr(a_ * y) + sqr(z)));
}

Vec3 Sheen::sample(const Vec2& u) const {
    const Vec3 o = to_cosine_hemisphere(u);
    const Vec3 w = normalize(Vec3(o.x - b_ * o.z, o.y, a_ * o.z));
    return {along_.x * w.x - along_.y * w.y, along_.y * w.x + along_.x * w.y, side_ * w.z};
}

}  // namespace wend
