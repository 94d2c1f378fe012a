#include <wend/numeric/quadrature.h>
#include <wend/planar/case_modes.h>
#include <wend/planar/half_space.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

/// Σ coefficient[i] f(nu[i])
template <class Function>
double sum(const CaseModes& modes, const Function& f) {
    double total = 0;
    for (std::size_t i = 0; i < modes.nu.size(); ++i) {
        total += modes.coefficient[i] * f(modes.nu[i]);
    }
    return total;
}

double value(const CaseModes& modes, double x) {
    return sum(modes, [&](double nu) { return std::exp(-x / nu); });
}

/// The mean over directions of the radiance that the sky and scattering with the given modes of J bring to depth x: J
/// again, if and only if the modes solve the transport equation.
double transported(const CaseModes& modes, double albedo, double x) {
    const Quadrature rule = gauss_legendre(200);
    double total = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        const double t = rule.nodes[i];
        const double m = t * t * t;
        const double sky = std::exp(-x / m);
        const double from_above =
            sky + sum(modes, [&](double nu) { return albedo * nu * (std::exp(-x / nu) - sky) / (nu - m); });
        const double from_below = sum(modes, [&](double nu) { return albedo * nu / (nu + m) * std::exp(-x / nu); });
        total += rule.weights[i] * 3 * t * t * (from_above + from_below) / 2;
    }
    return total;
}

TEST(CaseModes, HaveTheTabulatedAmplitude) {
    EXPECT_NEAR(case_modes(0.2, 0).coefficient.at(0), 0.003771, 5.1e-7);
    EXPECT_NEAR(case_modes(0.4, 0).coefficient.at(0), 0.125660, 5.1e-7);
    EXPECT_NEAR(case_modes(0.8, 0).coefficient.at(0), 0.535991, 5.1e-7);
    EXPECT_NEAR(case_modes(0.95, 0).coefficient.at(0), 0.756257, 5.1e-7);
    EXPECT_NEAR(case_modes(0.99, 0).coefficient.at(0), 0.884424, 5.1e-7);
}

TEST(CaseModes, HaveTheExactMoments) {
    for (const double albedo : {0.02, 0.2, 0.4, 0.8, 0.95, 0.999, 1 - 1e-9}) {
        SCOPED_TRACE(albedo);
        const CaseModes modes = case_modes(albedo, 200);
        const FluenceMoments exact = fluence_moments(albedo);
        EXPECT_NEAR(value(modes, 0), exact.at_surface, 1e-9);
        const double integral = sum(modes, [](double nu) { return nu; });
        EXPECT_NEAR(integral, exact.integral, 1e-9 * exact.integral);
        EXPECT_NEAR(sum(modes, [](double nu) { return nu * nu; }) / integral, exact.mean_depth,
                    1e-8 * exact.mean_depth);
        EXPECT_NEAR(sum(modes, [](double nu) { return 2 * nu * nu * nu; }) / integral, exact.mean_square,
                    1e-8 * exact.mean_square);
        for (const double mu0 : {0.1, 1.0}) {
            EXPECT_NEAR(albedo * sum(modes, [&](double nu) { return nu / (nu + mu0); }), reflectance(albedo, mu0),
                        1e-9);
        }
    }
}

TEST(CaseModes, SolveTheTransportEquation) {
    for (const double albedo : {0.2, 0.6, 0.95}) {
        const CaseModes modes = case_modes(albedo, 129);
        for (const double x : {0.0, 0.01, 0.3, 2.0, 9.0}) {
            EXPECT_NEAR(transported(modes, albedo, x), value(modes, x), 1e-8) << "albedo " << albedo << ", x " << x;
        }
    }
}

TEST(CaseModes, OfAnotherAlbedoDoNotSolveIt) {
    EXPECT_GT(std::abs(transported(case_modes(0.61, 129), 0.6, 0.3) - value(case_modes(0.61, 129), 0.3)), 1e-4);
}

TEST(CaseModes, ConvergeWithTheFourthPowerOfTheirNumber) {
    const double exact = fluence_moments(0.8).at_surface;
    double before = std::abs(value(case_modes(0.8, 8), 0) - exact);
    EXPECT_LT(before, 2e-6);
    for (const int transients : {16, 32, 64}) {
        const double error = std::abs(value(case_modes(0.8, transients), 0) - exact);
        EXPECT_LT(error, before / 16);
        before = error;
    }
}

TEST(CaseModes, ArePositiveAndStartWithTheDiscreteOne) {
    for (const double albedo : {1e-6, 1e-3, 0.01, 0.5, 0.9999, 1 - 1e-12}) {
        const CaseModes modes = case_modes(albedo, 32);
        ASSERT_EQ(modes.nu.size(), 33u);
        ASSERT_EQ(modes.coefficient.size(), 33u);
        EXPECT_GE(modes.nu[0], 1);
        // The first amplitude is about 2 exp(-2/albedo), and 0 where that is less than any double.
        EXPECT_EQ(modes.coefficient[0] > 0, albedo > 0.0028);
        for (std::size_t i = 1; i < modes.nu.size(); ++i) {
            EXPECT_GT(modes.coefficient[i], 0);
            EXPECT_GT(modes.nu[i], 0);
            EXPECT_LT(modes.nu[i], 1);
        }
    }
}

TEST(CaseModes, AreTrivialWithoutScatteringAndWithoutAbsorption) {
    EXPECT_TRUE(case_modes(0, 8).nu.empty());
    const CaseModes white = case_modes(1, 8);
    ASSERT_EQ(white.nu.size(), 1u);
    EXPECT_TRUE(std::isinf(white.nu[0]));
    EXPECT_EQ(value(white, 1e9), 1);
}

}  // namespace
}  // namespace wend
