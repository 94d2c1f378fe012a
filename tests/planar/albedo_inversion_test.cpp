#include <wend/planar/albedo_inversion.h>
#include <wend/planar/half_space.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

TEST(AlbedoInversion, InvertsTheReflectanceOfIsotropicHalfSpaces) {
    const AlbedoInversion albedo_of(0, 1);
    for (int i = 1; i < 100; ++i) {
        const float reflectance = 0.01f * static_cast<float>(i);
        const double albedo = static_cast<double>(albedo_of(reflectance));
        EXPECT_NEAR(diffuse_reflectance(albedo), reflectance, 5e-4) << "albedo " << albedo;
    }
}

TEST(AlbedoInversion, GrowsFromNothingToAll) {
    for (const double g : {-0.99, -0.5, 0.0, 0.8, 0.99}) {
        for (const double ior : {0.7, 1.0, 1.33, 1.5, 3.0, 4.0}) {
            const AlbedoInversion albedo_of(g, ior);
            EXPECT_EQ(albedo_of(0), 0) << g << ", " << ior;
            EXPECT_EQ(albedo_of(-1), 0) << g << ", " << ior;
            EXPECT_EQ(albedo_of(1), 1) << g << ", " << ior;
            EXPECT_EQ(albedo_of(2), 1) << g << ", " << ior;
            float before = 0;
            for (int i = 1; i < 50; ++i) {
                const float reflectance = 0.02f * static_cast<float>(i);
                const float albedo = albedo_of(reflectance);
                EXPECT_GT(albedo, before) << g << ", " << ior << ", " << reflectance;
                EXPECT_LE(albedo, 1) << g << ", " << ior << ", " << reflectance;
                before = albedo;
            }
        }
    }
}

// What scatters forwards, or is kept in by a boundary, has to absorb less for the same colour.
TEST(AlbedoInversion, DependsOnAnisotropyAndBoundary) {
    EXPECT_GT(AlbedoInversion(0.8, 1)(0.5f), AlbedoInversion(0, 1)(0.5f));
    EXPECT_GT(AlbedoInversion(0, 1.5)(0.5f), AlbedoInversion(0, 1)(0.5f));
}

}  // namespace
}  // namespace wend
