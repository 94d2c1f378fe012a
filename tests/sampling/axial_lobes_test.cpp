#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/sampling/axial_lobes.h>
#include <wend/sampling/vmf.h>

#include <gtest/gtest.h>

#include <array>

namespace wend {
namespace {

const Vec3 axis = normalize(Vec3(1, -2, 0.5f));

/// Nine lobes, more than one vector holds, two of them backward.
constexpr std::array<AxialLobe, 9> nine = {
    {{1, 0}, {2, 0.3f}, {1, -4}, {1, 9}, {3, 20}, {1, -60}, {2, 80}, {0, 7}, {1, 2}}};

TEST(AxialLobes, StartUniform) {
    EXPECT_EQ(AxialLobes().size(), 1);
    EXPECT_FLOAT_EQ(AxialLobes().density({0, 1, 0}), inv_4pi);
}

TEST(AxialLobes, DensityIsTheWeightedSumOfForwardAndBackwardLobes) {
    const AxialLobes lobes = AxialLobes(nine).around(axis);
    Pcg32 random(1);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 w = Vmf{}.sample(random.uniform2());
        double sum = 0, total = 0;
        for (const AxialLobe& lobe : nine) {
            const Vmf vmf{lobe.kappa < 0 ? -axis : axis, std::abs(lobe.kappa)};
            sum += static_cast<double>(lobe.weight) * vmf.density(w);
            total += lobe.weight;
        }
        EXPECT_NEAR(lobes.density(w), sum / total, 2e-5 * sum / total);
    }
}

template <class Density>
test::SphereTest sample_test(const AxialLobes& lobes, const Density& density) {
    return test::chi_square_sphere([&](Vec2 u) { return lobes.sample(u); }, density);
}

TEST(AxialLobes, SamplesFollowTheDensity) {
    const AxialLobes lobes = AxialLobes(nine).around(axis);
    EXPECT_TRUE(
        test::follows_density(sample_test(lobes, [&](const Vec3& w) { return lobes.density(w); }), "axial_lobes", 3));
}

TEST(AxialLobes, LobesTurnedAroundAreRejected) {
    const AxialLobes lobes = AxialLobes(nine).around(axis), wrong = lobes.around(-axis);
    EXPECT_LT(sample_test(lobes, [&](const Vec3& w) { return wrong.density(w); }).result.p_value, test::failing);
}

}  // namespace
}  // namespace wend
