#include <wend/numeric/quadrature.h>

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace wend {
namespace {

template <class Function>
double integrate(const Quadrature& rule, const Function& f) {
    double sum = 0;
    for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
        sum += rule.weights[i] * f(rule.nodes[i]);
    }
    return sum;
}

TEST(GaussLegendre, IsTheTabulatedRule) {
    const Quadrature one = gauss_legendre(1, -1, 1);
    EXPECT_DOUBLE_EQ(one.nodes[0], 0);
    EXPECT_DOUBLE_EQ(one.weights[0], 2);
    const Quadrature three = gauss_legendre(3, -1, 1);
    EXPECT_DOUBLE_EQ(three.nodes[0], -std::sqrt(0.6));
    EXPECT_NEAR(three.nodes[1], 0, 1e-16);
    EXPECT_DOUBLE_EQ(three.nodes[2], std::sqrt(0.6));
    EXPECT_DOUBLE_EQ(three.weights[0], 5.0 / 9);
    EXPECT_DOUBLE_EQ(three.weights[1], 8.0 / 9);
}

TEST(GaussLegendre, IsExactForPolynomialsUpToItsDegreeAndNotBeyond) {
    for (const int count : {1, 2, 7, 32, 63}) {
        const Quadrature rule = gauss_legendre(count);
        for (int degree = 0; degree < 2 * count; ++degree) {
            EXPECT_NEAR(integrate(rule, [&](double x) { return std::pow(x, degree); }), 1.0 / (degree + 1), 2e-15)
                << count << " nodes, degree " << degree;
        }
    }
    EXPECT_GT(std::abs(integrate(gauss_legendre(2), [](double x) { return std::pow(x, 4); }) - 0.2), 1e-3);
}

TEST(GaussLegendre, NodesIncreaseInsideTheInterval) {
    for (const int count : {1, 2, 5, 64, 511, 512}) {
        const Quadrature rule = gauss_legendre(count, -2, 3);
        double previous = -2;
        double total = 0;
        for (std::size_t i = 0; i < rule.nodes.size(); ++i) {
            EXPECT_LT(previous, rule.nodes[i]);
            EXPECT_GT(rule.weights[i], 0);
            previous = rule.nodes[i];
            total += rule.weights[i];
        }
        EXPECT_LT(previous, 3);
        EXPECT_NEAR(total, 5, 1e-14);
    }
}

TEST(GaussLegendre, LargeRulesAreAccurateToRounding) {
    const Quadrature rule = gauss_legendre(512, 0, std::numbers::pi);
    EXPECT_NEAR(integrate(rule, [](double x) { return std::sin(x) * std::cos(200 * x) * std::cos(200 * x); }),
                1 + 1.0 / (1 - 400.0 * 400), 1e-14);
}

}  // namespace
}  // namespace wend
