#include <tests/guide/mixtures.h>
#include <tests/guide/sphere_integral.h>
#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/guide/mixture.h>
#include <wend/medium/phase.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace wend::guide {
namespace {

using test::integrate_sphere;
using test::many_lobes;
using test::three_lobes;

const Vec3 axis = normalize(Vec3(1, -1, 0.5f));

VmfMixture one_lobe(const Vmf& vmf) {
    return VmfMixture(std::array{WeightedVmf{1, vmf}});
}

AxialLobes one_axial(const Vec3& along, float kappa) {
    return AxialLobes(std::array{AxialLobe{1, kappa}}).around(along);
}

AxialLobes henyey_greenstein(float g) {
    return HenyeyGreenstein{g}.lobes().around(axis);
}

/// Forward and backward, as of clouds.
AxialLobes two_lobed() {
    HenyeyGreensteinMixture phase;
    phase.add(0.7f, 0.85f);
    phase.add(0.3f, -0.5f);
    return phase.lobes().around(axis);
}

const std::vector<AxialLobes> all_lobes = {AxialLobes(),
                                           one_axial(axis, 2.18853f),
                                           henyey_greenstein(-0.95f),
                                           henyey_greenstein(-0.4f),
                                           henyey_greenstein(0.05f),
                                           henyey_greenstein(0.3f),
                                           henyey_greenstein(0.8f),
                                           henyey_greenstein(0.95f),
                                           two_lobed()};

TEST(MixtureProduct, IsThePointwiseProductOverItsIntegral) {
    for (const AxialLobes& lobes : all_lobes) {
        for (const VmfMixture& mixture : {VmfMixture(), three_lobes(0), many_lobes(5, 30)}) {
            const MixtureProduct product = mixture.product(lobes);
            const double integral =
                integrate_sphere([&](const Vec3& w) { return mixture.density(w) * lobes.density(w); }, 600);
            EXPECT_NEAR(product.integral(), integral, 1e-3 * integral) << lobes.kappa(0);
            Pcg32 random(6);
            for (int i = 0; i < 100; ++i) {
                const Vec3 w = Vmf{}.sample(random.uniform2());
                const double pointwise = mixture.density(w) * lobes.density(w);
                EXPECT_NEAR(product.integral() * product.density(w), pointwise, 1e-5 * pointwise);
            }
        }
    }
}

TEST(MixtureProduct, IntegratesToOne) {
    for (const AxialLobes& lobes : all_lobes) {
        const MixtureProduct product = many_lobes(1, 80).product(lobes);
        EXPECT_NEAR(integrate_sphere([&](const Vec3& w) { return product.density(w); }, 600), 1, 1e-3);
    }
}

test::SphereTest sample_test(const MixtureProduct& product, const test::DirectionDensity& density) {
    return test::chi_square_sphere([&](Vec2 u) { return product.sample(u); }, density);
}

TEST(MixtureProduct, SamplesFollowTheDensity) {
    int round = 0;
    for (const AxialLobes& lobes : all_lobes) {
        for (const VmfMixture& mixture : {three_lobes(0), many_lobes(4, 40)}) {
            const MixtureProduct product = mixture.product(lobes);
            EXPECT_TRUE(test::follows_density(sample_test(product, [&](const Vec3& w) { return product.density(w); }),
                                              "mixture_product_" + std::to_string(round++), 20));
        }
    }
}

TEST(MixtureProduct, ASlightlyOtherPhaseFunctionIsRejected) {
    const VmfMixture mixture = many_lobes(4, 40);
    const MixtureProduct product = mixture.product(henyey_greenstein(0.8f));
    const MixtureProduct wrong = mixture.product(henyey_greenstein(0.77f));
    EXPECT_LT(sample_test(product, [&](const Vec3& w) { return wrong.density(w); }).result.p_value, test::failing);
}

TEST(MixtureProduct, ASampleOfOneFactorIsRejected) {
    const VmfMixture mixture = three_lobes(0);
    const MixtureProduct product = mixture.product(two_lobed());
    EXPECT_LT(sample_test(product, [&](const Vec3& w) { return mixture.density(w); }).result.p_value, test::failing);
}

TEST(MixtureProduct, WithTheUniformLobeIsTheMixture) {
    const VmfMixture mixture = three_lobes(0);
    const MixtureProduct product = mixture.product(AxialLobes());
    EXPECT_NEAR(product.integral(), inv_4pi, 1e-6 * inv_4pi);
    Pcg32 random(1);
    for (int i = 0; i < 100; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 w = mixture.sample(u);
        EXPECT_NEAR(product.density(w), mixture.density(w), 2e-6 * mixture.density(w));
        EXPECT_NEAR(dot(product.sample(u), w), 1, 1e-5);
    }
}

TEST(MixtureProduct, OfNarrowLobesSideBySideKeepsItsPrecision) {
    // For large concentrations the integral is the planar Gaussian convolution, k e^{-k angle²/2} / (2 pi) with
    // 1/k = 1/kappa + 1/other; the product is centred at the weighted mean of the angles.
    const double angle = 0.004;
    const Vec3 beside(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
    const MixtureProduct product = one_lobe({{0, 0, 1}, 1e5f}).product(one_axial(beside, 5e4f));
    const double k = 1e5 * 5e4 / 1.5e5;
    const double expected = k / (2 * pi) * std::exp(-k * angle * angle / 2);
    EXPECT_NEAR(product.integral(), expected, 1e-3 * expected);
    double mean = 0, square = 0;
    constexpr int n = 200;
    for (int i = 0; i < n; ++i) {
        for (int j = 0; j < n; ++j) {
            const Vec3 w = product.sample({(static_cast<float>(i) + 0.5f) / n, (static_cast<float>(j) + 0.5f) / n});
            mean += w.x;
            square += w.y * static_cast<double>(w.y);
        }
    }
    EXPECT_NEAR(mean / (n * n), angle / 3, 1e-5);
    EXPECT_NEAR(square / (n * n) * 1.5e5, 1, 0.01);
}

TEST(MixtureProduct, OfOppositeLobesIsUniform) {
    for (const AxialLobes& lobes : {one_axial({0, 0, -1}, 2), one_axial({0, 0, 1}, -2)}) {
        const MixtureProduct product = one_lobe({{0, 0, 1}, 2}).product(lobes);
        for (const Vec3& w : {Vec3(0, 0, 1), Vec3(0, 0, -1), Vec3(1, 0, 0)}) {
            EXPECT_NEAR(product.density(w), inv_4pi, 1e-6);
        }
        EXPECT_NEAR(product.sample({0.5f, 0}).z, 0, 1e-6);
    }
}

TEST(MixtureProduct, ThatUnderflowsIsTheMixture) {
    const std::array<WeightedVmf, 2> lobes = {{{1.0f, {{0, 0, 1}, 1e4f}}, {1.0f, {{0, 1, 0}, 1e4f}}}};
    const VmfMixture mixture(lobes);
    const MixtureProduct product = mixture.product(one_axial(normalize(Vec3(0, -1, -2)), 1e5f));
    EXPECT_EQ(product.integral(), 0);
    const Vec3 w = product.sample({0.3f, 0.7f});
    EXPECT_EQ(w, mixture.sample({0.3f, 0.7f}));
    EXPECT_FLOAT_EQ(product.density(w), mixture.density(w));
}

TEST(MixtureProduct, SamplesAreUnitVectorsAtTheEdgesOfTheSquare) {
    for (const AxialLobes& lobes : all_lobes) {
        const MixtureProduct product = many_lobes(9, 1e5f).product(lobes);
        for (const float u : {0.0f, 0.5f, one_minus_epsilon}) {
            for (const float v : {0.0f, one_minus_epsilon}) {
                const Vec3 w = product.sample({u, v});
                EXPECT_NEAR(length(w), 1, 1e-5);
                EXPECT_GT(product.density(w), 0);
            }
        }
    }
}

}  // namespace
}  // namespace wend::guide
