#include <wend/planar/eigenvalue.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wend {
namespace {

TEST(DiscreteEigenvalue, AgreesWithSixtyDigits) {
    struct Row {
        double albedo, k, gap;
    };
    const std::vector<Row> rows = {
        {0.01, 1.0, 2.76779305347348658e-87},
        {0.03, 1.0, 2.22876631568067789e-29},
        {0.05, 0.999999999999999992, 8.49670851058319971e-18},
        {0.1, 0.999999995877692424, 4.12230757624879209e-9},
        {0.2, 0.999909121715232551, 0.000090878284767449112},
        {0.4, 0.985623871634656751, 0.0143761283653432491},
        {0.499, 0.957885114616721694, 0.0421148853832783058},
        {0.501, 0.957120733680968783, 0.0428792663190312171},
        {0.56, 0.930412301147527545, 0.0695876988524724551},
        {0.6, 0.90733231664530996, 0.0926676833546900404},
        {0.8, 0.710411783487870307, 0.289588216512129693},
        {0.9, 0.525429512658008678, 0.474570487341991322},
        {0.95, 0.379485206678090002, 0.620514793321909998},
        {0.99, 0.172511069975051299, 0.827488930024948701},
        {0.999, 0.0547503430915283855, 0.945249656908471614},
        {0.9999, 0.0173198152434875948, 0.982680184756512405},
        {0.999999, 0.0017320501147733386, 0.998267949885226661},
        {0.999999999, 0.0000547722549540751129, 0.999945227745045925},
        {0.999999999999, 1.73203164949063087e-6, 0.999998267968350509},
    };
    for (const Row& row : rows) {
        const DiscreteEigenvalue value = discrete_eigenvalue(row.albedo);
        EXPECT_NEAR(value.k, row.k, 1e-13 * row.k) << "albedo " << row.albedo;
        EXPECT_NEAR(value.gap, row.gap, 2e-13 * row.gap) << "albedo " << row.albedo;
        EXPECT_NEAR(value.nu(), 1 / row.k, 1e-13 / row.k) << "albedo " << row.albedo;
    }
}

TEST(DiscreteEigenvalue, HasItsLimits) {
    EXPECT_EQ(discrete_eigenvalue(0).nu(), 1);
    EXPECT_EQ(discrete_eigenvalue(0).gap, 0);
    EXPECT_EQ(discrete_eigenvalue(0.001).nu(), 1);
    EXPECT_EQ(discrete_eigenvalue(0.001).gap, 0);
    EXPECT_TRUE(std::isinf(discrete_eigenvalue(1).nu()));
    EXPECT_EQ(discrete_eigenvalue(1).gap, 1);
}

TEST(DiscreteEigenvalue, GrowsWithTheAlbedo) {
    double previous = 0;
    for (int i = 3; i <= 1000; ++i) {
        const double gap = discrete_eigenvalue(i / 1000.0).gap;
        EXPECT_GT(gap, previous) << "albedo " << i / 1000.0;
        previous = gap;
    }
}

TEST(DiscreteEigenvalue, AGivenLengthIsKept) {
    const DiscreteEigenvalue value = DiscreteEigenvalue::of_length(4);
    EXPECT_EQ(value.nu(), 4);
    EXPECT_EQ(value.k, 0.25);
    EXPECT_EQ(value.gap, 0.75);
}

TEST(DiscreteEigenvalueByMoments, IsTheIsotropicOneWithoutFurtherMoments) {
    for (const double albedo : {0.0, 0.01, 0.05, 0.1, 0.2, 0.5, 0.8, 0.99, 1 - 1e-9, 1 - 1e-15, 1.0}) {
        for (const std::vector<double>& moments : {std::vector<double>{1}, {1, 0, 0, 0, 0, 0, 0}}) {
            const DiscreteEigenvalue expected = discrete_eigenvalue(albedo);
            const DiscreteEigenvalue value = discrete_eigenvalue(albedo, moments);
            EXPECT_NEAR(value.k, expected.k, 1e-14 * expected.k) << "albedo " << albedo;
            EXPECT_NEAR(value.gap, expected.gap, 1e-15) << "albedo " << albedo;
        }
    }
}

TEST(DiscreteEigenvalueByMoments, AgreesWithFortyDigits) {
    struct Row {
        double albedo, g, nu;
    };
    const std::vector<Row> rows = {
        {0.8, 0.5, 1.84558484897559142},  {0.95, 0.5, 3.65850363649005517},         {0.95, 0.75, 5.02571714788713209},
        {0.8, 0.75, 2.36159016435120687}, {0.95, 0.9, 7.38583578917559466},         {0.99, 0.9, 17.8422341505211208},
        {0.8, -0.3, 1.27883515376415592}, {0.999999, 0.8, 1290.99330116941277},     {0.5, 0.9, 1.59806787344665955},
        {0.6, -0.6, 1.03016957273910622}, {0.999999999, 0.95, 81649.6588066788242},
    };
    for (const auto& [albedo, g, nu] : rows) {
        EXPECT_NEAR(discrete_eigenvalue_henyey_greenstein(albedo, g).nu(), nu, 1e-13 * nu)
            << "albedo " << albedo << ", g " << g;
    }
}

TEST(DiscreteEigenvalueByMoments, IsDefinedForTheSharpestPeaks) {
    for (const double g : {-0.99, 0.99}) {
        for (const double albedo : {0.0, 1e-9, 1e-3, 0.5, 1 - 1e-12, 1.0}) {
            const DiscreteEigenvalue value = discrete_eigenvalue_henyey_greenstein(albedo, g);
            EXPECT_GE(value.nu(), 1) << "albedo " << albedo << ", g " << g;
            EXPECT_LE(value.k, std::sqrt(3 * (1 - albedo) * (1 - albedo * g)) + 1e-15);
        }
    }
}

TEST(DiscreteEigenvalueByMoments, IsOneWhereBackscatteringLeavesNoRoot) {
    // Near nu = 1 the dispersion relation grows like -(1 + 3 f (1 - albedo)) ln(nu - 1), f the mean cosine: a root
    // needs the bracket to be positive.
    EXPECT_EQ(discrete_eigenvalue(0.5, std::vector<double>{1, -0.9}).nu(), 1);
    EXPECT_GT(discrete_eigenvalue(0.5, std::vector<double>{1, -0.5}).nu(), 1);
}

}  // namespace
}  // namespace wend
