#include <wend/numeric/legendre.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace wend {
namespace {

TEST(LegendrePolynomials, AreThoseOfTheStandardLibrary) {
    std::vector<double> values(65);
    for (const double x : {-1.0, -0.999, -0.3, 0.0, 0.1, 0.77, 1.0}) {
        legendre_polynomials(x, values);
        for (unsigned n = 0; n < values.size(); ++n) {
            EXPECT_NEAR(values[n], std::legendre(n, x), 1e-14) << "degree " << n << " at " << x;
        }
    }
}

TEST(LegendrePolynomials, FillsAnyNumberOfValues) {
    legendre_polynomials(0.5, {});
    std::array<double, 1> one{7};
    legendre_polynomials(0.5, one);
    EXPECT_EQ(one[0], 1);
}

}  // namespace
}  // namespace wend
