#include <wend/adjoint/constant.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

TEST(ConstantAdjoint, ScattersItsOwnRadianceWhateverTheLobe) {
    // A phase function integrates to 1, so constant radiance L scatters to L.
    const ConstantAdjoint adjoint(0.7f);
    for (const float g : {-0.6f, 0.0f, 0.3f, 0.95f}) {
        EXPECT_NEAR(in_scattered(adjoint, {1, 2, 3}, Vmf::with_mean_cosine({0, 1, 0}, g)), 0.7f, 1e-5) << g;
    }
}

TEST(ConstantAdjoint, TimesALobeIsTheLobe) {
    const Vmf lobe = Vmf::with_mean_cosine({0, 1, 0}, 0.8f);
    const Vmf product = ConstantAdjoint(1).incident({0, 0, 0}).product(lobe).distribution;
    EXPECT_NEAR(product.kappa, lobe.kappa, 1e-5f * lobe.kappa);
    EXPECT_NEAR(dot(product.mean, lobe.mean), 1, 1e-6);
}

struct NoProduct {
    Vec3 sample(Vec2) const;
    float density(const Vec3&) const;
};

TEST(IncidentRadiance, MustBeMultipliable) {
    static_assert(IncidentRadiance<Vmf>);
    static_assert(!IncidentRadiance<NoProduct>);
    static_assert(!Adjoint<Vmf>);
}

}  // namespace
}  // namespace wend
