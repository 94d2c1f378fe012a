#include <wend/core/random.h>
#include <wend/medium/fresnel.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

TEST(FresnelDielectric, NormalIncidence) {
    for (const float n : {1.0f, 1.33f, 1.5f, 2.4f, 0.75f}) {
        const float expected = sqr((n - 1) / (n + 1));
        EXPECT_NEAR(fresnel_dielectric(1.0f, n), expected, 1e-7f);
        EXPECT_NEAR(fresnel_dielectric(-1.0f, n), expected, 1e-7f);
    }
}

TEST(FresnelDielectric, AtBrewstersAngleOnlyOnePolarizationIsReflected) {
    for (const float n : {1.33f, 1.5f, 2.0f}) {
        // There the angles of incidence and refraction add up to 90 degrees: reflectance sin²(i - t) / 2.
        const float incidence = std::atan(n);
        const float expected = 0.5f * sqr(std::sin(2 * incidence - pi / 2));
        EXPECT_NEAR(fresnel_dielectric(std::cos(incidence), n), expected, 1e-6f);
    }
}

TEST(FresnelDielectric, ReflectsTotallyBeyondTheCriticalAngle) {
    const float n = 1.5f;
    const float critical = std::sqrt(1 - 1 / (n * n));
    EXPECT_EQ(fresnel_dielectric(-0.999f * critical, n), 1);
    EXPECT_EQ(fresnel_dielectric(-1e-3f, n), 1);
    EXPECT_LT(fresnel_dielectric(-1.01f * critical, n), 0.9f);
    EXPECT_LT(fresnel_dielectric(critical, n), 0.1f);
}

TEST(FresnelDielectric, GrazingIncidenceReflectsAll) {
    EXPECT_NEAR(fresnel_dielectric(1e-6f, 1.5f), 1, 1e-4f);
}

TEST(FresnelDielectric, BothWaysThroughTheBoundaryAreAlike) {
    const float n = 1.4f;
    Pcg32 random(1);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 w = to_cosine_hemisphere(random.uniform2());
        const auto refraction = refract(w, {0, 0, 1}, n);
        ASSERT_TRUE(refraction);
        EXPECT_NEAR(fresnel_dielectric(w.z, n), fresnel_dielectric(refraction->direction.z, n), 2e-5f);
    }
}

TEST(FresnelConductor, KnownValues) {
    // (n-1)² + k² over (n+1)² + k² at normal incidence.
    for (const auto& [n, k] : {std::pair{0.2f, 3.9f}, {1.5f, 2.0f}, {3.0f, 0.1f}}) {
        EXPECT_NEAR(fresnel_conductor(1, n, k), (sqr(n - 1) + sqr(k)) / (sqr(n + 1) + sqr(k)), 1e-6f);
        EXPECT_NEAR(fresnel_conductor(0, n, k), 1, 1e-6f);
    }
    // Born and Wolf's closed form for oblique incidence.
    const double n = 0.2, k = 3.9, cosine = 0.5, c2 = 0.25, s2 = 0.75;
    const double d = n * n - k * k - s2;
    const double a2b2 = std::sqrt(d * d + 4 * n * n * k * k), a = std::sqrt(0.5 * (a2b2 + d));
    const double perpendicular = (a2b2 + c2 - 2 * a * cosine) / (a2b2 + c2 + 2 * a * cosine);
    const double parallel =
        perpendicular * (c2 * a2b2 + s2 * s2 - 2 * a * cosine * s2) / (c2 * a2b2 + s2 * s2 + 2 * a * cosine * s2);
    EXPECT_NEAR(fresnel_conductor(0.5f, 0.2f, 3.9f), 0.5 * (perpendicular + parallel), 1e-5);
}

TEST(FresnelConductor, WithoutAbsorptionIsADielectric) {
    for (const float cosine : {1.0f, 0.7f, 0.3f, 0.05f}) {
        EXPECT_NEAR(fresnel_conductor(cosine, 1.5f, 0), fresnel_dielectric(cosine, 1.5f), 1e-6f);
    }
}

TEST(Refract, FollowsSnellsLawInThePlaneOfIncidence) {
    Pcg32 random(2);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 n = to_sphere(random.uniform2()), w = to_sphere(random.uniform2());
        const float ior = 0.6f + 1.5f * random.uniform();
        const auto refraction = refract(w, n, ior);
        const float ratio = dot(n, w) > 0 ? ior : 1 / ior;
        const float sine = length(cross(w, n));
        if (sine > ratio * 1.001f) {
            EXPECT_FALSE(refraction);
        } else if (sine < ratio * 0.999f) {
            ASSERT_TRUE(refraction);
            EXPECT_FLOAT_EQ(refraction->ior, ratio);
            EXPECT_NEAR(length(refraction->direction), 1, 1e-5f);
            EXPECT_LT(length(cross(refraction->direction, n) * ratio + cross(w, n)), 1e-5f);
            EXPECT_LT(dot(refraction->direction, n) * dot(w, n), 0);
        }
    }
}

TEST(Refract, TheWayBackIsTheSame) {
    Pcg32 random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 n = to_sphere(random.uniform2()), w = to_sphere(random.uniform2());
        if (const auto there = refract(w, n, 1.5f); there && std::abs(dot(there->direction, n)) > 0.1f) {
            const auto back = refract(there->direction, n, 1.5f);
            ASSERT_TRUE(back);
            EXPECT_LT(length(back->direction - w), 3e-4f);
            EXPECT_FLOAT_EQ(back->ior * there->ior, 1);
        }
    }
}

TEST(DiffuseReflectance, KnownValues) {
    // Walsh's closed form gives 0.0918 from outside and 0.5964 from inside for an index of 1.5.
    EXPECT_NEAR(fresnel_diffuse_reflectance(1.5f), 0.0918f, 5e-5f);
    EXPECT_NEAR(fresnel_diffuse_reflectance(1 / 1.5f), 0.5964f, 2e-4f);
    EXPECT_NEAR(fresnel_diffuse_reflectance(1), 0, 1e-7f);
}

TEST(DiffuseReflectance, BothSidesAreRelatedByTheSquaredIndex) {
    for (const float n : {1.2f, 1.33f, 2.0f}) {
        EXPECT_NEAR(1 - fresnel_diffuse_reflectance(1 / n), (1 - fresnel_diffuse_reflectance(n)) / (n * n), 2e-4f);
    }
}

}  // namespace
}  // namespace wend
