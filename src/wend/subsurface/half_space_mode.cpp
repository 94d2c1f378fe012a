#include <wend/subsurface/half_space_mode.h>

#include <wend/numeric/fast_math.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Legendre's polynomials, summed with coefficients, as powers.
std::vector<float> to_powers(std::span<const double> legendre) {
    std::vector<double> sum(legendre.size());
    std::vector<double> before;
    std::vector<double> current = {1};
    for (std::size_t l = 0; l < legendre.size(); ++l) {
        for (std::size_t i = 0; i < current.size(); ++i) {
            sum[i] += legendre[l] * current[i];
        }
        const auto n = static_cast<double>(l);
        std::vector<double> next(current.size() + 1);
        for (std::size_t i = 0; i < current.size(); ++i) {
            next[i + 1] += (2 * n + 1) / (n + 1) * current[i];
        }
        for (std::size_t i = 0; i < before.size(); ++i) {
            next[i] -= n / (n + 1) * before[i];
        }
        before = std::move(current);
        current = std::move(next);
    }
    return {sum.begin(), sum.end()};
}

}  // namespace

HalfSpaceMode::HalfSpaceMode(double k, double albedo, std::span<const double> source)
    : k_(static_cast<float>(k)),
      albedo_(static_cast<float>(albedo)),
      source_(to_powers(source)),
      has_constant_source_(source.size() == 1),
      logarithm_(std::log1p(2 * k_ / (1 - k_))) {
    constexpr int steps = 256;
    source_.resize((source_.size() + stride - 1) / stride * stride);
    most_ = least_ = inward_ = radiance(-1);
    for (int i = 1; i <= steps; ++i) {
        const float value = radiance(-1 + 2 * static_cast<float>(i) / steps);
        most_ = std::max(most_, value);
        least_ = std::min(least_, value);
    }
    most_ *= 1.01f;  // it may be larger between the steps, by far less
}

Vec3 HalfSpaceMode::sample(const PhaseFunction& phase, const Vec3& before, const Vec3& normal, Pcg32& random) const {
    if (k_ == 0) {
        // Light that comes from everywhere alike is no reason to turn: the density is the phase function.
        return phase.sample(before, random.uniform2());
    }
    if (has_constant_source_ && phase.is_isotropic()) {
        // (1 - k mu)^-1 is inverted in closed form.
        const Vec2 u = random.uniform2();
        const float cosine = -1 - (1 + k_) / k_ * fast_expm1(-logarithm_ * u.x);
        return Frame::from_z(normal).to_world(direction_from_cosine(std::clamp(cosine, -1.0f, 1.0f), u.y));
    }
    for (;;) {
        const Vec3 w = phase.sample(before, random.uniform2());
        if (random.uniform() * most_ < radiance(dot(w, normal))) {
            return w;
        }
    }
}

}  // namespace wend
