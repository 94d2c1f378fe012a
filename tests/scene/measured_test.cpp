#include "tests/support/measured_tables.h"

#include <wend/core/random.h>
#include <wend/scene/bsdf/bsdf.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

Vec3 direction(float angle, float azimuth) {
    return {std::sin(angle) * std::cos(azimuth), std::sin(angle) * std::sin(azimuth), std::cos(angle)};
}

TEST(Measured, AnEvenReflectanceIsLamberts) {
    const Rgb reflectance(0.8f, 0.5f, 0.2f);
    Pcg32 random(1);
    for (const bool is_isotropic : {true, false}) {
        const MeasuredTables tables(test::even_reflectance(reflectance, is_isotropic));
        const MeasuredBsdf bsdf{&tables};
        // The angles are those of slices: between them tables are interpolated.
        for (const float angle : {0.0f, 0.4f, 1.2f}) {
            // So are azimuths, where these count.
            const Vec3 wo = direction(angle, is_isotropic ? 2.3f : 1.5f);
            Moments share;
            for (int i = 0; i < 4000; ++i) {
                const auto s = bsdf.sample(wo, random.uniform(), random.uniform2());
                share.add(s ? s->value.g / s->density : 0);
                const Vec3 wi = direction(1.4f * random.uniform(), 2 * pi * random.uniform());
                EXPECT_NEAR(bsdf.evaluate(wo, wi).r, 0.8f * wi.z / pi, 0.006f) << wo << wi;
                EXPECT_EQ(bsdf.evaluate(wo, wi), bsdf.evaluate(-wo, -wi));
                EXPECT_TRUE(is_black(bsdf.evaluate(wo, -wi)));
                EXPECT_EQ(bsdf.density(wo, -wi), 0);
            }
            EXPECT_NEAR(share.mean(), 0.5, 0.01) << angle;
            EXPECT_LT(std::sqrt(share.variance()), 0.2) << angle;
            EXPECT_NEAR(directional_albedo(bsdf, wo).b, 0.2f, 0.01f);
            EXPECT_NEAR(directional_albedo(bsdf, -wo).b, 0.2f, 0.01f);
        }
    }
}

TEST(Measured, IsotropicOnesTurnWithTheView) {
    const MeasuredTables isotropic(test::uneven_reflectance(true)), anisotropic(test::uneven_reflectance(false));
    const Vec3 wo = direction(0.7f, 0.3f), wi = direction(0.5f, 2), turned_wo = direction(0.7f, 2.3f),
               turned_wi = direction(0.5f, 4);
    const auto value = [](const MeasuredTables& tables, const Vec3& o, const Vec3& i) {
        return MeasuredBsdf{&tables}.evaluate(o, i).g;
    };
    EXPECT_NEAR(value(isotropic, wo, wi), value(isotropic, turned_wo, turned_wi), 1e-5f);
    EXPECT_GT(std::abs(value(anisotropic, wo, wi) - value(anisotropic, turned_wo, turned_wi)), 1e-3f);
}

}  // namespace
}  // namespace wend
