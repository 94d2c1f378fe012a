#include <tests/support/chi_square_sphere.h>
#include <wend/core/vector.h>
#include <wend/sampling/vmf.h>

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace wend {
namespace {

const Vec3 tilted = normalize(Vec3(0.3f, -0.8f, 0.5f));

/// A direction whose cosine with the mean is 1 - s.
Vec3 at(const Vec3& mean, double s, double azimuth) {
    const double sine = std::sqrt(s * (2 - s));
    return Frame::from_z(mean).to_world({static_cast<float>(sine * std::cos(azimuth)),
                                         static_cast<float>(sine * std::sin(azimuth)), static_cast<float>(1 - s)});
}

/// 2 pi ∫ f ds over the part of [0, 2] where the lobe is not negligible, by the midpoint rule.
template <class Function>
double integrate_around(const Vec3& mean, float kappa, const Function& f) {
    constexpr int steps = 20000;
    const double end = kappa > 20 ? 40.0 / kappa : 2.0;
    double sum = 0;
    for (int i = 0; i < steps; ++i) {
        const double s = end * (i + 0.5) / steps;
        sum += f(at(mean, s, 2.4 * i));
    }
    return sum * end / steps * 2 * pi;
}

TEST(Vmf, IntegratesToOneAtEveryConcentration) {
    for (const float kappa : {0.0f, 1e-30f, 1e-6f, 1e-3f, 0.1f, 1.0f, 10.0f, 300.0f, 1e4f, 1e5f}) {
        const Vmf lobe{tilted, kappa};
        EXPECT_NEAR(integrate_around(tilted, kappa, [&](const Vec3& w) { return lobe.density(w); }), 1, 2e-4)
            << "kappa " << kappa;
    }
}

TEST(Vmf, SamplesFollowTheDensity) {
    std::uint64_t seed = 1;
    for (const float kappa : {0.0f, 1e-5f, 0.5f, 5.0f, 60.0f}) {
        const Vmf lobe{tilted, kappa};
        test::SphereTestOptions options;
        options.seed = ++seed;
        EXPECT_TRUE(
            test::follows_density(test::chi_square_sphere([&](Vec2 u) { return lobe.sample(u); },
                                                          [&](const Vec3& w) { return lobe.density(w); }, options),
                                  "vmf", 5))
            << "kappa " << kappa;
    }
}

TEST(Vmf, ATooNarrowDensityIsRejected) {
    const Vmf lobe{tilted, 5.0f}, wrong{tilted, 5.3f};
    const auto test = test::chi_square_sphere([&](Vec2 u) { return lobe.sample(u); },
                                              [&](const Vec3& w) { return wrong.density(w); });
    EXPECT_LT(test.result.p_value, 1e-6);
}

TEST(Vmf, NarrowLobesFollowTheirDensityToo) {
    // In x = kappa (1 - cos) a narrow lobe is the exponential distribution; the chi-square grid is too coarse for it.
    for (const float kappa : {1e3f, 1e5f}) {
        const Vmf lobe{tilted, kappa};
        constexpr int samples = 100000, cells = 20;
        std::vector<std::uint64_t> observed(cells, 0);
        Pcg32 random(7);
        for (int i = 0; i < samples; ++i) {
            const double s = 0.5 * length_squared(lobe.sample(random.uniform2()) - tilted);
            ++observed[static_cast<std::size_t>(std::min(cells * (1 - std::exp(-kappa * s)), cells - 1.0))];
        }
        const std::vector<double> expected(cells, samples / static_cast<double>(cells));
        EXPECT_GT(chi_square_test(observed, expected).p_value, 0.005) << "kappa " << kappa;
    }
}

TEST(Vmf, SamplesAreUnitVectorsAtTheEdgesOfTheSquare) {
    for (const float kappa : {0.0f, 1e-38f, 1.0f, 50.0f, 1e5f}) {
        for (const float u : {0.0f, 0.5f, one_minus_epsilon}) {
            const Vec3 w = Vmf{tilted, kappa}.sample({u, u});
            EXPECT_NEAR(length(w), 1, 2e-6) << "kappa " << kappa << ", u " << u;
        }
    }
}

TEST(Vmf, MeanCosineIsTheMeanOfTheCosine) {
    for (const float kappa : {0.01f, 0.5f, 3.0f, 100.0f, 1e4f}) {
        const Vmf lobe{tilted, kappa};
        const double mean_deficit = integrate_around(
            tilted, kappa, [&](const Vec3& w) { return lobe.density(w) * 0.5 * length_squared(w - tilted); });
        EXPECT_NEAR(1 - vmf_mean_cosine(kappa), mean_deficit, 2e-4 * mean_deficit + 1e-7) << "kappa " << kappa;
    }
}

TEST(Vmf, ConcentrationInvertsMeanCosine) {
    for (const float kappa : {1e-4f, 0.01f, 0.049f, 0.051f, 0.5f, 3.0f, 100.0f, 3000.0f}) {
        // 1 - mean cosine is 1/kappa, held with the precision of a float near 1.
        const double tolerance = kappa * (2e-7 * kappa + 1e-5);
        EXPECT_NEAR(vmf_kappa(vmf_mean_cosine(kappa)), kappa, tolerance);
    }
    EXPECT_EQ(vmf_kappa(0), 0);
    EXPECT_EQ(vmf_kappa(-0.5f), 0);
    EXPECT_EQ(vmf_kappa(1), Vmf::max_kappa);
}

TEST(Vmf, ConvolutionMultipliesMeanCosines) {
    const Vmf convolved = convolve({tilted, 12}, 3);
    EXPECT_NEAR(vmf_mean_cosine(convolved.kappa), vmf_mean_cosine(12) * vmf_mean_cosine(3), 1e-6);
    EXPECT_EQ(convolved.mean, tilted);
}

}  // namespace
}  // namespace wend
