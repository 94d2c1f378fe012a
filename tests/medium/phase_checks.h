// What every phase function must fulfil, by quadrature.
#pragma once

#include <wend/medium/phase.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend::test {

/// 2 pi ∫ f(cosine) d cosine, in steps that grow away from forward and backward, where the lobes are.
template <class Function>
double integrate(const Function& f) {
    constexpr int steps = 200000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double angle = pi * (i + 0.5) / steps;
        sum += f(std::cos(angle)) * std::sin(angle);
    }
    return sum * pi / steps * 2 * pi;
}

template <class Phase>
void expect_normalized(const Phase& phase) {
    EXPECT_NEAR(integrate([&](double c) { return phase.evaluate(static_cast<float>(c)); }), 1, 1e-4);
    EXPECT_NEAR(integrate([&](double c) { return c * phase.evaluate(static_cast<float>(c)); }), phase.mean_cosine(),
                1e-4);
}

/// ∫ p(before, ω) h(ω) dω for the function h around a mean direction, by the midpoint rule.
template <class Phase>
double convolved_by_quadrature(const Phase& phase, const Vec3& before, const Vec3& mean) {
    constexpr int rows = 600;
    const HenyeyGreenstein around{length(mean)};
    const Vec3 axis = normalize(mean);
    double sum = 0;
    for (int i = 0; i < rows; ++i) {
        const double z = -1 + (2 * i + 1.0) / rows, r = std::sqrt(1 - z * z);
        for (int j = 0; j < 2 * rows; ++j) {
            const double azimuth = pi * (j + 0.5) / rows;
            const Vec3 w(static_cast<float>(r * std::cos(azimuth)), static_cast<float>(r * std::sin(azimuth)),
                         static_cast<float>(z));
            sum += phase.evaluate(dot(before, w)) * around.evaluate(dot(axis, w));
        }
    }
    return sum * 2 * pi / (static_cast<double>(rows) * rows);
}

template <class Phase>
void expect_convolved(const Phase& phase) {
    const Vec3 before = normalize(Vec3(1, 2, -1));
    for (const float size : {0.01f, 0.4f, 0.9f}) {
        for (const Vec3& towards : {Vec3(1, 0, 0), Vec3(1, 2, -0.9f), Vec3(-1, -2, 1.2f)}) {
            const Vec3 mean = normalize(towards) * size;
            const double expected = convolved_by_quadrature(phase, before, mean);
            EXPECT_NEAR(phase.convolved(before, mean), expected, 2e-3 * expected) << size << ' ' << towards;
            EXPECT_NEAR(PhaseFunction(phase).convolved(before, mean), expected, 2e-3 * expected);
        }
    }
    EXPECT_NEAR(phase.convolved(before, Vec3(0, 0, 0)), inv_4pi, 1e-6);
}

}  // namespace wend::test
