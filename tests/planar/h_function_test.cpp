#include <wend/numeric/quadrature.h>
#include <wend/planar/h_function.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <vector>

namespace wend {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

TEST(HFunction, AgreesWithThirtyDigits) {
    struct Row {
        double albedo, mu, h;
    };
    for (const auto& [albedo, mu, h] : {Row{0.01, 0.5, 1.0027602861643366},
                                        {0.3, 1e-06, 1.0000021081552431},
                                        {0.5, 3.0, 1.3362937364728936},
                                        {0.8, 0.3, 1.3005882784318875},
                                        {0.8, 1.0, 1.5982195185331596},
                                        {0.95, 1.5, 2.3751819080914225},
                                        {0.999, 0.001, 1.0044730757050496},
                                        {0.999999999, 0.7, 2.3738838958326758},
                                        {0.999999999, 18257.0, 15811.822424578352},
                                        {1.0, 0.2, 1.4503514128100948},
                                        {1.0, 1.0, 2.9078105290786057},
                                        {1.0, 50.0, 87.831436817933828}}) {
        EXPECT_NEAR(HFunction(albedo)(mu), h, 1e-14 * h) << "albedo " << albedo << ", mu " << mu;
    }
}

TEST(HFunction, AgreesWithThePublishedTable) {
    constexpr std::array albedos = {0.2, 0.4, 0.5, 0.6, 0.8, 0.9, 0.95, 0.99, 1.0};
    struct Row {
        double mu;
        std::array<double, 9> h;
    };
    const std::vector<Row> rows = {
        {0.1,
         {1.025617819, 1.055359551, 1.072368762, 1.091348590, 1.138807666, 1.172143054, 1.195231810, 1.224875290,
          1.247350442}},
        {0.2,
         {1.038916999, 1.085780883, 1.113461429, 1.145164512, 1.228638766, 1.291433728, 1.337336775, 1.399767224,
          1.450351413}},
        {0.3,
         {1.048295524, 1.107898824, 1.143889509, 1.185867866, 1.300588278, 1.391350321, 1.460453906, 1.558712877,
          1.642522264}},
        {0.5,
         {1.061176632, 1.139192062, 1.187735133, 1.245807160, 1.413262569, 1.556033802, 1.671788293, 1.848601016,
          2.012778770}},
        {0.7,
         {1.069820232, 1.160799916, 1.218559869, 1.288870947, 1.499539736, 1.689347600, 1.850917413, 2.112624063,
          2.373974913}},
        {0.9,
         {1.076098861, 1.176810756, 1.241693732, 1.321701402, 1.568542775, 1.800787358, 2.006503692, 2.356942209,
          2.730587665}},
        {1.0,
         {1.078645066, 1.183380667, 1.251259563, 1.335406673, 1.598219519, 1.850098517, 2.077123842, 2.472792828,
          2.907810529}},
    };
    for (std::size_t i = 0; i < albedos.size(); ++i) {
        const HFunction h(albedos[i]);
        for (const Row& row : rows) {
            EXPECT_NEAR(h(row.mu), row.h[i], 5.1e-10) << "albedo " << albedos[i] << ", mu " << row.mu;
        }
    }
}

TEST(HFunction, SolvesItsIntegralEquation) {
    // 1/H(mu) = sqrt(1 - albedo) + (albedo/2) ∫ m H(m) / (mu + m) dm.
    const Quadrature rule = gauss_legendre(100);
    for (const double albedo : {1e-3, 0.3, 0.9, 0.9999, 1.0}) {
        const HFunction h(albedo);
        for (const double mu : {0.02, 0.6, 1.0, 7.0, 1e4}) {
            double sum = 0;
            for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
                const double t = rule.nodes[i];
                const double m = t * t * t;
                sum += rule.weights[i] * 3 * t * t * m * h(m) / (mu + m);
            }
            const double inverse = std::sqrt(1 - albedo) + albedo / 2 * sum;
            EXPECT_NEAR(h(mu) * inverse, 1, 1e-13) << "albedo " << albedo << ", mu " << mu;
        }
    }
}

TEST(HFunction, HasItsMoments) {
    for (const double albedo : {0.1, 0.4, 0.8, 0.95, 0.99, 1 - 1e-9, 1.0}) {
        const double alpha0 = 2 / (1 + std::sqrt(1 - albedo));
        EXPECT_NEAR(HFunction(albedo).moment(0), alpha0, 1e-14 * alpha0) << "albedo " << albedo;
    }
    EXPECT_NEAR(HFunction(1).moment(1), 2 / std::sqrt(3.0), 1e-14);
    EXPECT_NEAR(HFunction(0.4).moment(1), 0.57621284, 5e-9);
    EXPECT_NEAR(HFunction(0.8).moment(1), 0.73581523, 5e-9);
    // Published to six digits by deon2019.
    const std::array published = {1.02718, 0.721955, 0.557658, 0.45458, 0.383773, 0.332099, 0.292712, 0.261689};
    const HFunction h(0.99);
    for (std::size_t i = 0; i < published.size(); ++i) {
        EXPECT_NEAR(h.moment(static_cast<int>(i) + 1), published[i], 6e-6);
    }
}

TEST(HFunction, HasItsLimits) {
    for (const double albedo : {0.0, 1e-6, 0.5, 0.99}) {
        const HFunction h(albedo);
        EXPECT_EQ(h(0), 1);
        EXPECT_NEAR(h(infinity), 1 / std::sqrt(1 - albedo), 1e-15 / std::sqrt(1 - albedo));
        for (const double mu : {1e100, 1e300, 1e308}) {
            EXPECT_NEAR(h(mu), h(infinity), 1e-14 * h(infinity)) << "albedo " << albedo;
        }
        EXPECT_NEAR(h(1), h(std::nextafter(1.0, 2.0)), 2e-15 * h(1));
    }
    EXPECT_TRUE(std::isinf(HFunction(1)(infinity)));
    EXPECT_NEAR(HFunction(1)(1e12), std::sqrt(3.0) * 1e12, 2e12 * 1e-11);
    EXPECT_EQ(HFunction(0)(0.7), 1);
}

TEST(HFunction, LogarithmKeepsItsDigitsForALittleScattering) {
    // To first order in the albedo ln H = (albedo/2) mu ln((1 + mu)/mu).
    constexpr double albedo = 1e-10;
    for (const double mu : {1e-3, 0.4, 1.0, 1.7}) {
        const double expected = albedo / 2 * mu * std::log1p(1 / mu);
        EXPECT_NEAR(HFunction(albedo).logarithm(mu), expected, 1e-9 * expected);
    }
}

}  // namespace
}  // namespace wend
