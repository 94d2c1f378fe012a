#include <wend/planar/half_space.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wend {
namespace {

// Printed values are right to half a unit of their last digit.
constexpr double six_digits = 5.1e-7;
constexpr double eight_digits = 5.1e-9;

TEST(Reflectance, AgreesWithIndependentSolutions) {
    // By adding and doubling, and by walks.
    struct Row {
        double albedo, mu0, reflectance;
    };
    for (const auto& [albedo, mu0, expected] : {Row{0.2, 1, 0.03523052},
                                                {0.4, 1, 0.08335728},
                                                {0.6, 1, 0.15541466},
                                                {0.8, 1, 0.28525450},
                                                {0.9, 1, 0.41494748},
                                                {0.95, 1, 0.53554099},
                                                {0.99, 1, 0.75272072},
                                                {0.4, 0.5, 0.11758562},
                                                {0.8, 0.5, 0.36796976},
                                                {0.95, 0.5, 0.62617677}}) {
        EXPECT_NEAR(reflectance(albedo, mu0), expected, eight_digits) << "albedo " << albedo << ", mu0 " << mu0;
    }
    EXPECT_NEAR(diffuse_reflectance(0.4), 0.10733491, eight_digits);
    EXPECT_NEAR(diffuse_reflectance(0.8), 0.34186685, eight_digits);
    EXPECT_NEAR(diffuse_reflectance(0.95), 0.59666878, eight_digits);
    EXPECT_NEAR(diffuse_reflectance(0.99), 0.79456365, eight_digits);
}

TEST(Reflectance, UniformIncidenceHasAClosedForm) {
    for (const double albedo : {0.0, 0.3, 0.9, 1.0}) {
        const double r = std::sqrt(1 - albedo);
        EXPECT_NEAR(uniform_reflectance(albedo), (1 - r) / (1 + r), 1e-15);
    }
}

TEST(Reflectance, IsNothingWithoutScatteringAndEverythingWithoutAbsorption) {
    for (const double mu0 : {0.0, 1e-3, 1.0}) {
        EXPECT_EQ(reflectance(0, mu0), 0);
        EXPECT_EQ(reflectance(1, mu0), 1);
    }
    EXPECT_NEAR(diffuse_reflectance(0), 0, 1e-15);
    EXPECT_EQ(diffuse_reflectance(1), 1);
}

TEST(Reflectance, IsSingleScatteringForALittleAlbedo) {
    // (albedo/2) ∫ m / (1 + m) dm at normal incidence.
    constexpr double albedo = 1e-9;
    EXPECT_NEAR(reflectance(albedo, 1) / albedo, (1 - std::log(2.0)) / 2, 1e-9);
}

TEST(Variance, HasTheTabulatedValues) {
    struct Row {
        double albedo, classical, first_classical, first_stretched;
    };
    for (const Row& row : {Row{0.2, 0.005056, 0.008613, 0.005236},
                           {0.4, 0.020413, 0.016204, 0.008715},
                           {0.6, 0.048163, 0.023295, 0.009932},
                           {0.8, 0.093393, 0.031117, 0.008507},
                           {0.9, 0.122797, 0.033407, 0.006092},
                           {0.95, 0.132755, 0.030174, 0.003954},
                           {0.99, 0.105151, 0.014520, 0.001146}}) {
        EXPECT_NEAR(classical_variance(row.albedo, 1), row.classical, six_digits) << "albedo " << row.albedo;
        EXPECT_NEAR(dwivedi_variance(row.albedo, 1, FirstFlight::classical), row.first_classical, six_digits);
        EXPECT_NEAR(dwivedi_variance(row.albedo, 1, FirstFlight::stretched), row.first_stretched, six_digits);
    }
}

TEST(Variance, VanishesAtBothEnds) {
    for (const double albedo : {0.0, 1.0}) {
        EXPECT_NEAR(classical_variance(albedo, 0.7), 0, 1e-15);
        EXPECT_NEAR(dwivedi_variance(albedo, 0.7, FirstFlight::classical), 0, 1e-14);
        EXPECT_NEAR(dwivedi_variance(albedo, 0.7, FirstFlight::stretched), 0, 1e-14);
    }
    for (const double albedo : {1e-6, 1e-3, 1 - 1e-9}) {
        EXPECT_GE(dwivedi_variance(albedo, 1e-3, FirstFlight::stretched), -1e-14) << "albedo " << albedo;
    }
}

TEST(StretchedSecondMoment, IsDwivedisAtTheEigenvalueAndClassicalWithoutStretching) {
    for (const double albedo : {0.02, 0.2, 0.8, 0.99}) {
        for (const double mu0 : {0.1, 1.0}) {
            const double mean = reflectance(albedo, mu0);
            for (const FirstFlight first : {FirstFlight::classical, FirstFlight::stretched}) {
                EXPECT_NEAR(stretched_second_moment(albedo, discrete_eigenvalue(albedo), mu0, first) - mean * mean,
                            dwivedi_variance(albedo, mu0, first), 1e-13)
                    << "albedo " << albedo;
                EXPECT_NEAR(stretched_second_moment(albedo, discrete_eigenvalue(1), mu0, first) - mean * mean,
                            classical_variance(albedo, mu0), 1e-14)
                    << "albedo " << albedo;
            }
        }
    }
}

TEST(StretchedSecondMoment, IsLeastAtTheTabulatedLength) {
    struct Row {
        double albedo, ratio, variance;
    };
    for (const auto& [albedo, ratio, variance] : {Row{0.2, 1.158, 0.001122},
                                                  {0.4, 1.170, 0.003745},
                                                  {0.6, 1.145, 0.006631},
                                                  {0.8, 1.075, 0.007557},
                                                  {0.95, 1.015, 0.003909},
                                                  {0.99, 1.003, 0.001145}}) {
        const double mean = reflectance(albedo, 1);
        const auto variance_at = [&, c = albedo](double scale) {
            const auto guide = DiscreteEigenvalue::of_length(scale * discrete_eigenvalue(c).nu());
            return stretched_second_moment(c, guide, 1, FirstFlight::stretched) - mean * mean;
        };
        EXPECT_NEAR(variance_at(ratio), variance, six_digits) << "albedo " << albedo;
        EXPECT_LE(variance_at(ratio), variance_at(ratio + 0.002));
        EXPECT_LE(variance_at(ratio), variance_at(ratio - 0.002));
    }
}

TEST(StretchedSecondMoment, IsFiniteIfTheGuidesAlbedoIsAtLeastTheSquare) {
    for (const double albedo : {0.3, 0.8, 0.95}) {
        const double limit = albedo * albedo;
        EXPECT_NEAR(effective_albedo(albedo, discrete_eigenvalue(limit)), 1, 1e-13);
        for (const double share : {0.5, 0.85, 0.99, 1.01, 1.1}) {
            const DiscreteEigenvalue guide = discrete_eigenvalue(share * limit);
            EXPECT_NEAR(effective_albedo(albedo, guide), 1 / share, 1e-13);
            const double moment = stretched_second_moment(albedo, guide, 1, FirstFlight::stretched);
            EXPECT_EQ(std::isfinite(moment), share > 1) << "albedo " << albedo << ", share " << share;
        }
    }
    EXPECT_TRUE(std::isinf(effective_albedo(0.5, DiscreteEigenvalue::of_length(1))));
    EXPECT_EQ(effective_albedo(0, DiscreteEigenvalue::of_length(1)), 0);
}

TEST(ExtrapolationDistance, AgreesWithCasesIntegral) {
    // case1967: (albedo/2) ∫_0^1 (1 + albedo m²/(1 - m²)) nu atanh(m/nu) / ((1 - albedo m atanh m)² + (π albedo m/2)²)
    // dm, evaluated with thirty digits.
    struct Row {
        double albedo, distance;
    };
    for (const auto& [albedo, distance] : {Row{0.05, 18.1732518603711054},
                                           {0.2, 3.92390821878165552},
                                           {0.5, 1.44084994803628954},
                                           {0.8, 0.889054602477511692},
                                           {0.95, 0.747878266144891538},
                                           {0.999, 0.711157261013370647},
                                           {0.999999, 0.71044680004557727}}) {
        EXPECT_NEAR(extrapolation_distance(albedo), distance,
                    1e-14 * distance * (1 + discrete_eigenvalue(albedo).nu()));
    }
    EXPECT_NEAR(extrapolation_distance(1), 0.710446089598763, 1e-15);
    EXPECT_NEAR(extrapolation_distance(1 - 1e-9), 0.710446089598763, 1e-9);
    EXPECT_NEAR(extrapolation_distance(1e-3) * 1e-3, 1, 0.01);
}

TEST(FluenceMoments, HaveTheTabulatedValues) {
    struct Row {
        double albedo, at_surface, integral, mean_depth, ratio;
    };
    for (const Row& row : {Row{0.2, 0.527864, 0.298042, 0.728810, 0.804342},
                           {0.4, 0.563508, 0.371944, 0.821216, 0.887473},
                           {0.8, 0.690983, 0.822666, 1.342033, 1.380960},
                           {0.95, 0.817256, 2.016656, 2.610813, 2.630062},
                           {0.99, 0.909091, 5.135909, 5.787400, 5.795850}}) {
        const FluenceMoments moments = fluence_moments(row.albedo);
        EXPECT_NEAR(moments.at_surface, row.at_surface, six_digits);
        EXPECT_NEAR(moments.integral, row.integral, six_digits);
        EXPECT_NEAR(moments.mean_depth, row.mean_depth, six_digits);
        EXPECT_NEAR(moments.mean_square / (2 * moments.mean_depth), row.ratio, six_digits);
    }
}

TEST(FluenceMoments, HaveTheirLimits) {
    // Without scattering J = E_2(x) / 2.
    const FluenceMoments nothing = fluence_moments(0);
    EXPECT_DOUBLE_EQ(nothing.at_surface, 0.5);
    EXPECT_NEAR(nothing.integral, 0.25, 1e-15);
    EXPECT_NEAR(nothing.mean_depth, 2.0 / 3, 1e-14);
    EXPECT_NEAR(nothing.mean_square, 1, 1e-14);
    EXPECT_EQ(fluence_moments(1).at_surface, 1);
    EXPECT_TRUE(std::isinf(fluence_moments(1).mean_depth));
}

}  // namespace
}  // namespace wend
