#include <wend/adjoint/constant.h>

#include <gtest/gtest.h>

#include <array>

namespace wend {
namespace {

AxialLobes two_lobes() {
    return AxialLobes(std::array{AxialLobe{2, 30}, AxialLobe{1, -1.5f}}).around({0, 1, 0});
}

TEST(ConstantAdjoint, ScattersItsOwnRadianceWhateverTheLobes) {
    // A phase function integrates to 1, so constant radiance L scatters to L.
    const ConstantAdjoint adjoint(0.7f);
    for (const AxialLobes& lobes : {AxialLobes(), two_lobes()}) {
        EXPECT_NEAR(in_scattered(adjoint, {1, 2, 3}, lobes).g, 0.7f, 1e-5);
    }
}

TEST(ConstantAdjoint, TimesLobesIsThoseLobes) {
    const AxialLobes lobes = two_lobes();
    const auto product = ConstantAdjoint(1).incident({0, 0, 0}).product(lobes);
    for (const Vec3& w : {Vec3(0, 1, 0), Vec3(1, 0, 0), Vec3(0, -1, 0)}) {
        EXPECT_EQ(product.density(w), lobes.density(w));
    }
    EXPECT_EQ(product.sample({0.3f, 0.6f}), lobes.sample({0.3f, 0.6f}));
}

struct NoProduct {
    Vec3 sample(Vec2) const;
    float density(const Vec3&) const;
};

TEST(IncidentRadiance, MustBeMultipliable) {
    static_assert(IncidentRadiance<UniformRadiance>);
    static_assert(!IncidentRadiance<NoProduct>);
    static_assert(!Adjoint<UniformRadiance>);
}

}  // namespace
}  // namespace wend
