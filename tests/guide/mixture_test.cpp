#include <tests/guide/mixtures.h>
#include <tests/guide/sphere_integral.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/guide/mixture.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <vector>

namespace wend::guide {
namespace {

using test::integrate_sphere;
using test::many_lobes;
using test::three_lobes;

TEST(VmfMixture, StartsUniform) {
    EXPECT_FLOAT_EQ(VmfMixture().density({0, 1, 0}), inv_4pi);
    EXPECT_EQ(VmfMixture().size(), 1);
}

TEST(VmfMixture, IntegratesToOne) {
    EXPECT_NEAR(integrate_sphere([m = three_lobes(0.3f)](const Vec3& w) { return m.density(w); }), 1, 1e-4);
    EXPECT_NEAR(integrate_sphere([m = many_lobes(1, 80)](const Vec3& w) { return m.density(w); }), 1, 2e-4);
}

TEST(VmfMixture, DensityIsTheWeightedSumOfItsLobes) {
    const VmfMixture mixture = many_lobes(2, 80);
    Pcg32 random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 w = Vmf{}.sample(random.uniform2());
        double sum = 0;
        for (int k = 0; k < mixture.size(); ++k) {
            sum += static_cast<double>(mixture.lobe(k).weight) * mixture.lobe(k).vmf.density(w);
        }
        EXPECT_NEAR(mixture.density(w), sum, 1e-5 * sum);
    }
}

TEST(VmfMixture, SamplesFollowTheDensity) {
    const auto follows = [](const VmfMixture& mixture, std::uint64_t seed) {
        test::SphereTestOptions options;
        options.seed = seed;
        return test::follows_density(
            test::chi_square_sphere([&](Vec2 u) { return mixture.sample(u); },
                                    [&](const Vec3& w) { return mixture.density(w); }, options),
            "mixture", 3);
    };
    EXPECT_TRUE(follows(three_lobes(0.3f), 1));
    EXPECT_TRUE(follows(many_lobes(4, 40), 2));
}

TEST(VmfMixture, AMixtureThatIsSlightlyOffIsRejected) {
    const VmfMixture mixture = three_lobes(0.3f);
    const MixtureProduct wrong =
        mixture.product(AxialLobes(std::array{AxialLobe{1, 0.1f}}).around(normalize(Vec3(1, 0, 1))));
    const auto test = test::chi_square_sphere([&](Vec2 u) { return mixture.sample(u); },
                                              [&](const Vec3& w) { return wrong.density(w); });
    EXPECT_LT(test.result.p_value, 1e-6);
}

TEST(VmfMixture, SelectsLobesAtTheEdgesOfTheSquare) {
    // The last lobe has no weight: rounding must not select it.
    const std::array<WeightedVmf, 3> lobes = {
        {{0.0f, {{0, 0, -1}, 1e4f}}, {0.3f, {{0, 0, 1}, 1e4f}}, {0.0f, {{0, 0, -1}, 1e4f}}}};
    const VmfMixture mixture(lobes);
    for (const float u : {0.0f, 0.5f, one_minus_epsilon}) {
        EXPECT_GT(mixture.sample({u, u}).z, 0.9f);
    }
}

TEST(VmfMixture, ReAimingFollowsTheSourceAndLeavesFarLobesAlone) {
    const std::array<WeightedVmf, 2> lobes = {{{1.0f, {{0, 0, 1}, 50}}, {1.0f, {{0, 1, 0}, 50}}}};
    Lanes inverse_distance;
    inverse_distance[0] = 0.5f;  // a source at (0, 0, 2)
    const Vec3 position(1, 0, 0.5f);
    const VmfMixture seen = VmfMixture(lobes).re_aimed(-position, inverse_distance);
    EXPECT_NEAR(dot(seen.lobe(0).vmf.mean, normalize(Vec3(0, 0, 2) - position)), 1, 1e-6);
    EXPECT_EQ(seen.lobe(1).vmf.mean, Vec3(0, 1, 0));
    // At the source itself there is no direction to turn to.
    EXPECT_EQ(VmfMixture(lobes).re_aimed({0, 0, -2}, inverse_distance).lobe(0).vmf.mean, Vec3(0, 0, 1));
}

}  // namespace
}  // namespace wend::guide
