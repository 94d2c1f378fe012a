#include <tests/sampling/verdicts.h>
#include <wend/medium/averaged_phase.h>
#include <wend/numeric/legendre.h>
#include <wend/numeric/quadrature.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

namespace wend {
namespace {

const std::vector<double> all_g = {0, 1e-9, -1e-3, 0.3, -0.3, 0.8, -0.9, 0.99, -0.99};

/// Henyey and Greenstein's function of the scattering angle, per steradian, at two polar angles and an azimuth.
double henyey_greenstein(double g, double theta, double theta_new, double phi) {
    // The squared half chord between the directions, for a precise peak: cosine = 1 - 2 chord.
    const double chord = std::pow(std::sin((theta - theta_new) / 2), 2) +
                         std::sin(theta) * std::sin(theta_new) * std::pow(std::sin(phi / 2), 2);
    const double distance = g >= 0 ? (1 - g) * (1 - g) + 4 * g * chord : (1 + g) * (1 + g) - 4 * g * (1 - chord);
    return (1 - g * g) / (4 * std::numbers::pi * distance * std::sqrt(distance));
}

/// The azimuthal average by brute force: the trapezoidal rule of a periodic function.
double average(double g, double theta, double theta_new) {
    constexpr int steps = 20000;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        sum += henyey_greenstein(g, theta, theta_new, 2 * std::numbers::pi * i / steps);
    }
    return sum * 2 * std::numbers::pi / steps;
}

TEST(AveragedHenyeyGreenstein, IsTheNumericalAverageOverAzimuth) {
    for (const double g : all_g) {
        for (const double theta : {0.0, 1e-3, 0.4, 1.5, 2.9, std::numbers::pi}) {
            for (const double theta_new : {0.0, 0.4, 0.401, 1.2, 3.0, std::numbers::pi}) {
                const double expected = average(g, theta, theta_new);
                // The angle is known to rounding of its cosine only, which matters in the peak.
                EXPECT_NEAR(averaged_henyey_greenstein(g, std::cos(theta), std::cos(theta_new)), expected,
                            1e-11 * expected)
                    << "g " << g << ", from " << theta << " to " << theta_new;
            }
        }
    }
}

TEST(AveragedHenyeyGreenstein, IsOneHalfWithoutAnisotropy) {
    EXPECT_DOUBLE_EQ(averaged_henyey_greenstein(0, 0.3, -0.9), 0.5);
}

TEST(AveragedHenyeyGreenstein, HasTheLegendreMomentsOfItsMeanCosine) {
    // ∫ P_l(mu_new) p(mu_new | mu) = g^l P_l(mu), which l = 0 makes a normalization.
    constexpr double mu = 0.35;
    std::vector<double> at_mu(6);
    legendre_polynomials(mu, at_mu);
    for (const double g : {0.0, 0.5, -0.6, 0.9}) {
        std::vector<double> moments(6);
        // The density has a sharp peak at mu_new = ±mu, where panels meet.
        for (const auto& [begin, end] : {std::pair(-1.0, -mu), std::pair(-mu, mu), std::pair(mu, 1.0)}) {
            const Quadrature rule = gauss_legendre(400, begin, end);
            for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                std::vector<double> p(6);
                legendre_polynomials(rule.nodes[i], p);
                for (std::size_t l = 0; l < p.size(); ++l) {
                    moments[l] += rule.weights[i] * p[l] * averaged_henyey_greenstein(g, mu, rule.nodes[i]);
                }
            }
        }
        for (std::size_t l = 0; l < moments.size(); ++l) {
            EXPECT_NEAR(moments[l], std::pow(g, l) * at_mu[l], 1e-12) << "g " << g << ", degree " << l;
        }
    }
}

TEST(AzimuthDensity, IsThePhaseFunctionOverItsAverage) {
    for (const double g : all_g) {
        for (const double phi : {-3.1, -0.2, 0.0, 1.0, 3.0}) {
            const double expected = henyey_greenstein(g, 0.7, 2.2, phi) / average(g, 0.7, 2.2);
            EXPECT_NEAR(azimuth_density(g, std::cos(0.7), std::cos(2.2), phi), expected, 1e-11 * expected);
        }
    }
}

/// Whether drawn azimuths follow the density for `density_g`: counts against its integral over equal
/// cells of azimuth.
double p_value(double g, double density_g, double mu, double mu_new) {
    constexpr int cells = 64;
    constexpr int samples = 100000;
    std::vector<std::uint64_t> counts(cells);
    Pcg32 random(11);
    for (int i = 0; i < samples; ++i) {
        const double phi = sample_azimuth(g, mu, mu_new, random);
        EXPECT_LE(std::abs(phi), std::numbers::pi);
        const double turn = phi / (2 * std::numbers::pi) + 0.5;
        ++counts[std::min(static_cast<std::size_t>(turn * cells), counts.size() - 1)];
    }
    std::vector<double> expected;
    double total = 0;
    for (int i = 0; i < cells; ++i) {
        const double width = 2 * std::numbers::pi / cells;
        const Quadrature rule = gauss_legendre(64, -std::numbers::pi + i * width, -std::numbers::pi + (i + 1) * width);
        double probability = 0;
        for (std::size_t j = 0; j < rule.nodes.size(); ++j) {
            probability += rule.weights[j] * azimuth_density(density_g, mu, mu_new, rule.nodes[j]);
        }
        expected.push_back(samples * probability);
        total += probability;
    }
    EXPECT_NEAR(total, 1, 1e-9);
    return chi_square_test(counts, expected).p_value;
}

TEST(SampleAzimuth, FollowsItsDensity) {
    for (const double g : {0.0, 0.3, -0.5, 0.9, -0.95}) {
        for (const double mu_new : {0.3, 0.45, -0.3, -0.95}) {
            EXPECT_GE(p_value(g, g, 0.3, mu_new), test::passing) << "g " << g << ", to " << mu_new;
        }
    }
}

TEST(SampleAzimuth, AnotherMeanCosineIsRejected) {
    EXPECT_LT(p_value(0.5, 0.52, 0.3, 0.45), test::failing);
    EXPECT_LT(p_value(-0.5, 0.5, 0.3, 0.45), test::failing);
}

TEST(SampleAzimuth, IsUniformFromAPole) {
    EXPECT_GE(p_value(0.9, 0.9, 1, 0.2), test::passing);
    EXPECT_GE(p_value(0.9, 0, 1, 0.2), test::passing);
}

}  // namespace
}  // namespace wend
