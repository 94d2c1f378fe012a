// A grid medium with known optical thickness: what tests of tracking compare with.
#pragma once

#include <wend/core/random.h>
#include <wend/medium/medium.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

namespace wend::test {

/// A density that varies smoothly between 0 and about 1, with empty parts.
inline std::shared_ptr<const Grid> smooth_grid(int n = 24) {
    return std::make_shared<Grid>(
        Vec3i(0), Vec3i(n), [](const Vec3i&, const Vec3i&) { return true; },
        [n](int x, int y, int z) {
            const float s = 7.0f / static_cast<float>(n);
            const float wave = std::sin(s * static_cast<float>(x)) * std::cos(0.8f * s * static_cast<float>(y)) +
                               0.3f * std::sin(1.3f * s * static_cast<float>(z) + 1);
            return std::max(0.0f, wave);
        });
}

/// A turned and stretched place in the world, so that index space and world differ in every way.
inline Transform index_from_world(int n = 24) {
    return Transform::translate(0.5 * n, 0.5 * n, 0.5 * n) * Transform::rotate(25, 1, 2, -1) *
           Transform::scale(0.4 * n, 0.5 * n, 0.3 * n);
}

/// Scale multiplies both coefficients.
inline GridMedium smooth_medium(const Rgb& absorption, const Rgb& scattering,
                                std::shared_ptr<const GridEmission> emission = nullptr) {
    constexpr int n = 24;
    return GridMedium(smooth_grid(n), index_from_world(n), Box3(Vec3(-1), Vec3(static_cast<float>(n))), absorption,
                      scattering, PhaseFunction(), std::move(emission));
}

/// Integrals of the density along a ray from 0 to each of equally spaced distances.
class DensityAlong {
public:
    DensityAlong(const GridMedium& medium, const Ray& ray, float length, int steps = 40000)
        : step_(static_cast<double>(length) / steps) {
        const auto index_ray = medium.to_index(ray);
        double sum = 0;
        integral_.push_back(0);
        for (int i = 0; i < steps; ++i) {
            const double value = medium.density().interpolate(index_ray.at(static_cast<float>((i + 0.5) * step_)));
            density_.push_back(value);
            integral_.push_back(sum += value * step_);
        }
    }

    /// Integral of the density up to a distance.
    double up_to(double t) const {
        const double x = std::clamp(t / step_, 0.0, static_cast<double>(density_.size()) - 1e-6);
        const auto i = static_cast<std::size_t>(x);
        return integral_[i] + (x - static_cast<double>(i)) * density_[i] * step_;
    }
    double total() const { return integral_.back(); }

    /// ∫ density(t) f(t, integral of the density up to t) dt
    template <class Function>
    double integrate(const Function& f) const {
        double sum = 0;
        for (std::size_t i = 0; i < density_.size(); ++i) {
            sum += density_[i] * f((static_cast<double>(i) + 0.5) * step_, integral_[i] + 0.5 * density_[i] * step_);
        }
        return sum * step_;
    }

private:
    double step_;
    std::vector<double> density_;
    std::vector<double> integral_;
};

/// Through the middle of smooth_medium() in a direction along no axis.
inline Ray ray_through_smooth_medium() {
    return {{-1.6f, -0.9f, -1.1f}, normalize(Vec3(1.6f, 1.0f, 1.2f))};
}

}  // namespace wend::test
