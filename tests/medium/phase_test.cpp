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

/// The cumulative distribution of the cosine, in double precision.
double cumulative(double g, double cosine) {
    const double root = std::sqrt(1 + g * (g - 2 * cosine));
    if (std::abs(g) < 1e-3) {
        return 0.5 * (1 + cosine) - 0.75 * g * (1 - cosine * cosine);
    }
    return (1 - g * g) / (2 * g) * (1 / root - 1 / (1 + g));
}

template <class Phase>
void expect_normalized(const Phase& phase) {
    EXPECT_NEAR(integrate([&](double c) { return phase.evaluate(static_cast<float>(c)); }), 1, 1e-4);
    EXPECT_NEAR(integrate([&](double c) { return c * phase.evaluate(static_cast<float>(c)); }), phase.mean_cosine(),
                1e-4);
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
