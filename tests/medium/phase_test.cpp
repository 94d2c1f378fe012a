#include "phase_checks.h"

#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/medium/phase.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <vector>

namespace wend {
namespace {

using test::expect_convolved;
using test::expect_normalized;

/// Both signs, both sides of the switch at 0.5, and values so small that the usual inversion cancels.
const std::vector<float> all_g = {0.0f,    1e-6f,    -1e-4f,   1e-2f, -0.3f, 0.4999f, 0.5f,
                                  0.5001f, -0.4999f, -0.5001f, 0.9f,  -0.9f, 0.99f};

HenyeyGreensteinMixture mixture() {
    HenyeyGreensteinMixture m;
    m.add(2, 0.8f);
    m.add(1, -0.4f);
    m.add(0.5f, 0);
    return m;
}

/// The cumulative distribution of the cosine, in double precision.
double cumulative(double g, double cosine) {
    const double root = std::sqrt(1 + g * (g - 2 * cosine));
    if (std::abs(g) < 1e-3) {
        return 0.5 * (1 + cosine) - 0.75 * g * (1 - cosine * cosine);
    }
    return (1 - g * g) / (2 * g) * (1 / root - 1 / (1 + g));
}

TEST(HenyeyGreenstein, IntegratesToOneAndHasTheMeanCosine) {
    for (const float g : all_g) {
        SCOPED_TRACE(g);
        expect_normalized(HenyeyGreenstein{g});
    }
    expect_normalized(mixture());
    EXPECT_FLOAT_EQ(mixture().mean_cosine(), (2 * 0.8f - 0.4f) / 3.5f);
}

TEST(HenyeyGreenstein, SampledCosineInvertsTheDistribution) {
    for (const float g : all_g) {
        for (int i = 0; i <= 1000; ++i) {
            const float u = std::min(static_cast<float>(i) / 1000, one_minus_epsilon);
            const float cosine = HenyeyGreenstein{g}.sample_cosine(u);
            ASSERT_GE(cosine, -1);
            ASSERT_LE(cosine, 1);
            // Rounding of the cosine, seen through the density there.
            const double slope = 2 * pi * HenyeyGreenstein{g}.evaluate(cosine);
            ASSERT_NEAR(cumulative(g, cosine), u, 1e-6 * (1 + slope)) << "g " << g;
        }
    }
}

TEST(HenyeyGreenstein, FormsAgreeAtTheSwitch) {
    const float below = std::nextafter(0.5f, 0.0f);
    for (const float sign : {1.0f, -1.0f}) {
        for (int i = 0; i < 1000; ++i) {
            const float u = (static_cast<float>(i) + 0.5f) / 1000;
            EXPECT_NEAR(HenyeyGreenstein{sign * 0.5f}.sample_cosine(u), HenyeyGreenstein{sign * below}.sample_cosine(u),
                        1e-6f);
        }
    }
}

TEST(HenyeyGreenstein, TinyGKeepsItsResolution) {
    // The usual inversion leaves 18 distinct cosines at g = 1e-6.
    for (const float g : {1e-4f, 1e-6f, -1e-8f}) {
        std::set<float> cosines;
        for (int i = 0; i < 10000; ++i) {
            cosines.insert(HenyeyGreenstein{g}.sample_cosine((static_cast<float>(i) + 0.5f) / 10000));
        }
        EXPECT_EQ(cosines.size(), 10000u) << g;
    }
}

TEST(PhaseFunction, SamplesFollowTheDensity) {
    const Vec3 before = normalize(Vec3(-0.4f, 0.7f, -0.2f));
    std::vector<PhaseFunction> phases = {PhaseFunction(mixture())};
    for (const float g : {0.0f, 1e-3f, 0.3f, 0.4999f, 0.5001f, -0.8f, 0.9f}) {
        phases.emplace_back(HenyeyGreenstein{g});
    }
    test::SphereTestOptions options;
    for (const PhaseFunction& phase : phases) {
        ++options.seed;
        EXPECT_TRUE(test::follows_density(
            test::chi_square_sphere([&](Vec2 u) { return phase.sample(before, u); },
                                    [&](const Vec3& w) { return phase.evaluate(dot(before, w)); }, options),
            "phase", static_cast<int>(phases.size())))
            << "mean cosine " << phase.mean_cosine();
    }
}

TEST(PhaseFunction, AWrongGOrSignIsRejected) {
    const Vec3 before(0, 0, 1);
    const PhaseFunction phase(HenyeyGreenstein{0.3f});
    for (const float wrong : {0.33f, -0.3f}) {
        const auto test =
            test::chi_square_sphere([&](Vec2 u) { return phase.sample(before, u); },
                                    [&](const Vec3& w) { return HenyeyGreenstein{wrong}.evaluate(dot(before, w)); });
        EXPECT_LT(test.result.p_value, test::failing) << wrong;
    }
}

TEST(PhaseFunction, RefusesWhatIsNoFunction) {
    for (const float g : {-1.0f, 1.0f, 2.0f, std::numeric_limits<float>::quiet_NaN()}) {
        EXPECT_THROW(PhaseFunction(HenyeyGreenstein{g}), InputError) << g;
    }
}

TEST(PhaseFunction, PositiveGScattersStraightOn) {
    const Vec3 before = normalize(Vec3(1, 2, -3));
    const PhaseFunction forward(HenyeyGreenstein{0.95f});
    EXPECT_GT(forward.evaluate(1), 1000 * forward.evaluate(-1));
    Pcg32 random(4);
    Moments cosine;
    for (int i = 0; i < 20000; ++i) {
        cosine.add(dot(before, forward.sample(before, random.uniform2())));
    }
    EXPECT_TRUE(test::is_within_one_percent(cosine, 0.95));
}

TEST(HenyeyGreenstein, BlurredIsTheConvolution) {
    for (const float g : {0.0f, 0.3f, -0.6f, 0.9f}) {
        SCOPED_TRACE(g);
        expect_convolved(HenyeyGreenstein{g});
    }
    expect_convolved(mixture());
}

TEST(HenyeyGreenstein, BlurredByNothingIsItself) {
    const Vec3 before(0, 0, 1);
    for (const float g : {0.5f, -0.8f, 0.95f}) {
        for (const Vec3& w : {Vec3(0, 0, 1), Vec3(0.6f, 0, 0.8f), Vec3(0, 0, -1)}) {
            const float sharp = HenyeyGreenstein{g}.evaluate(w.z);
            EXPECT_NEAR(HenyeyGreenstein{g}.convolved(before, w), sharp, 1e-4f * sharp);
        }
    }
    EXPECT_TRUE(std::isfinite(HenyeyGreenstein{0.999999f}.convolved(before, before)));
}

}  // namespace
}  // namespace wend
