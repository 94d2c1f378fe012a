#include "phase_checks.h"

#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/core/error.h>
#include <wend/medium/phase.h>
#include <wend/numeric/legendre.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

namespace wend {
namespace {

/// Isotropic, Rayleigh's, Henyey and Greenstein's, Cornette and Shanks', fog's, and what is peaked or nearly dark
/// aside.
const std::vector<Draine> all = {
    Draine(0, 0),     Draine(0, 1),     Draine(0.5f, 0),   Draine(-0.7f, 1),   Draine(1e-4f, 3),
    Draine(0.3f, 40), Draine(0.9f, 20), Draine(-0.99f, 2), Draine(0.02f, 250), Draine(0.6f, Draine::largest_alpha)};

/// The cumulative distribution of the cosine, in double precision; g is not close to 0.
double cumulative(const Draine& phase, double cosine) {
    const double g = phase.g(), alpha = phase.alpha(), sum = 1 + g * g;
    const auto integral = [&](double s) {
        return -1 / s + alpha / (4 * g * g) * (-sum * sum / s - 2 * sum * s + s * s * s / 3);
    };
    const double difference = integral(1 + g) - integral(std::sqrt(sum - 2 * g * cosine));
    return (1 - g * g) / (2 * g) * difference / (1 + alpha * (1 + 2 * g * g) / 3);
}

TEST(Draine, IntegratesToOneAndHasTheMeanCosine) {
    for (const Draine& phase : all) {
        SCOPED_TRACE(testing::Message() << phase.g() << ' ' << phase.alpha());
        test::expect_normalized(phase);
    }
    EXPECT_FLOAT_EQ(Draine(0.5f, 2).mean_cosine(), 0.5f * (1 + 2 * 3.5f / 5) / (1 + 2 * 1.5f / 3));
}

TEST(Draine, MomentsAreIntegralsOfLegendrePolynomials) {
    const auto legendre = [](int l, double c) {
        std::vector<double> values(static_cast<std::size_t>(l) + 1);
        legendre_polynomials(c, values);
        return values.back();
    };
    for (const Draine& phase : all) {
        for (const int l : {0, 1, 2, 3, 6}) {
            const double expected =
                test::integrate([&](double c) { return phase.evaluate(static_cast<float>(c)) * legendre(l, c); });
            EXPECT_NEAR(phase.moment(l), expected, 2e-4) << phase.g() << ' ' << phase.alpha() << ' ' << l;
        }
    }
}

TEST(Draine, SpecialCases) {
    for (const float c : {-1.0f, -0.4f, 0.0f, 0.7f, 1.0f}) {
        EXPECT_FLOAT_EQ(Draine(-0.6f, 0).evaluate(c), HenyeyGreenstein{-0.6f}.evaluate(c));
        EXPECT_FLOAT_EQ(Draine(0, 1).evaluate(c), 0.75f * inv_4pi * (1 + c * c));
        const float g = 0.4f;
        EXPECT_FLOAT_EQ(Draine(g, 1).evaluate(c), HenyeyGreenstein{g}.evaluate(c) * 1.5f * (1 + c * c) / (2 + g * g));
        EXPECT_NEAR(Draine(-0.6f, 0).sample_cosine(0.5f * (1 + c) * one_minus_epsilon),
                    HenyeyGreenstein{-0.6f}.sample_cosine(0.5f * (1 + c) * one_minus_epsilon), 1e-5f);
    }
    EXPECT_TRUE(PhaseFunction(Draine(0, 0)).is_isotropic());
    EXPECT_FALSE(PhaseFunction(Draine(0, 1)).is_isotropic());
}

TEST(Draine, SampledCosineInvertsTheDistribution) {
    for (const float g : {0.1f, -0.1f, 0.5f, -0.9f, 0.99f}) {
        for (const float alpha : {0.0f, 1.0f, 40.0f, 250.0f, Draine::largest_alpha}) {
            const Draine phase(g, alpha);
            float last = -1;
            for (int i = 0; i <= 2000; ++i) {
                const float u = std::min(static_cast<float>(i) / 2000, one_minus_epsilon);
                const float cosine = phase.sample_cosine(u);
                ASSERT_GE(cosine, last - 1e-6f) << "g " << g << " alpha " << alpha << " u " << u;
                ASSERT_LE(std::abs(cosine), 1);
                last = cosine;
                // Rounding of the cosine, seen through the density there.
                const double slope = 2 * pi * phase.evaluate(cosine);
                ASSERT_NEAR(cumulative(phase, cosine), u, 1e-6 * (1 + slope)) << "g " << g << " alpha " << alpha;
            }
        }
    }
}

TEST(Draine, SamplesFollowTheDensity) {
    // 200,000 samples each.
    const Vec3 before = normalize(Vec3(-0.4f, 0.7f, -0.2f));
    test::SphereTestOptions options;
    for (const Draine& draine : all) {
        if (std::abs(draine.g()) > 0.9f) {
            continue;  // narrower than a cell
        }
        ++options.seed;
        const PhaseFunction phase(draine);
        EXPECT_TRUE(test::follows_density(
            test::chi_square_sphere([&](Vec2 u) { return phase.sample(before, u); },
                                    [&](const Vec3& w) { return phase.evaluate(dot(before, w)); }, options),
            "draine", static_cast<int>(all.size())))
            << draine.g() << ' ' << draine.alpha();
    }
}

TEST(Draine, AWrongAlphaOrGIsRejected) {
    // 200,000 samples each, in cells of the cosine alone.
    test::SphereTestOptions options;
    options.azimuth_cells = 1;
    const Vec3 before(0, 0, 1);
    const PhaseFunction phase(Draine(0.3f, 5));
    for (const Draine& wrong : {Draine(0.3f, 4.5f), Draine(0.28f, 5), Draine(-0.3f, 5)}) {
        const auto test =
            test::chi_square_sphere([&](Vec2 u) { return phase.sample(before, u); },
                                    [&](const Vec3& w) { return wrong.evaluate(dot(before, w)); }, options);
        EXPECT_LT(test.result.p_value, test::failing) << wrong.g() << ' ' << wrong.alpha();
    }
}

TEST(Draine, BlurredIsTheConvolution) {
    for (const Draine& phase : {Draine(0, 1), Draine(0.3f, 40), Draine(-0.6f, 2), Draine(0.9f, 20), Draine(1e-4f, 3)}) {
        SCOPED_TRACE(testing::Message() << phase.g() << ' ' << phase.alpha());
        test::expect_convolved(phase);
    }
}

TEST(Draine, BlurredByNothingIsItself) {
    for (const Vec3& w : {Vec3(0, 0, 1), Vec3(0.6f, 0, 0.8f), Vec3(0, 0, -1)}) {
        const float sharp = Draine(0.8f, 9).evaluate(w.z);
        EXPECT_NEAR(Draine(0.8f, 9).convolved(Vec3(0, 0, 1), w), sharp, 1e-4f * sharp);
    }
}

TEST(Draine, RefusesWhatIsNoFunction) {
    constexpr float nan = std::numeric_limits<float>::quiet_NaN();
    for (const float g : {-1.0f, 1.0f, nan}) {
        EXPECT_THROW(Draine(g, 1), InputError) << g;
    }
    for (const float alpha : {-0.1f, 2e6f, nan}) {
        EXPECT_THROW(Draine(0, alpha), InputError) << alpha;
    }
}

}  // namespace
}  // namespace wend
