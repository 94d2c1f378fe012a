// Light from a disk of the sky: its irradiance is known.
#include <tests/sampling/verdicts.h>
#include <wend/core/vector.h>
#include <wend/scene/light.h>
#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

SkyDiskLight disk(const Vec3& direction, double half_degrees) {
    const double half = half_degrees * 3.14159265358979 / 180;
    return {normalize(direction), Rgb(1, 2, 4), static_cast<float>(2 * std::pow(std::sin(half / 2), 2))};
}

TEST(SkyDiskLight, IrradianceIsThatOfItsSolidAngle) {
    // pi L sin² on a surface that faces it, and times a cosine on one that sees all of it.
    Pcg32 random(1);
    const Vec3 towards = normalize(Vec3(1, 2, 3));
    constexpr double rounding = 1e-6;
    for (const double half : {0.1, 0.265, 5.0, 40.0}) {
        const Light light = disk(towards, half);
        for (const float tilt : {0.0f, 0.7f}) {
            const Vec3 normal = Frame::from_z(towards).to_world({std::sin(tilt), 0, std::cos(tilt)});
            Moments moments;
            for (int i = 0; i < 200000; ++i) {
                const auto s = sample_light(light, Vec3(7, 8, 9), random.uniform2(), random);
                ASSERT_TRUE(s);
                EXPECT_EQ(s->distance, infinity);
                EXPECT_FALSE(s->point_like);
                moments.add(s->radiance.g * std::max(0.0f, dot(normal, s->direction)) / s->density);
            }
            const double sine = std::sin(half * 3.14159265358979 / 180);
            EXPECT_TRUE(agrees(moments, 2 * pi * sine * sine * std::cos(tilt), 4, rounding)) << half;
        }
    }
}

TEST(SkyDiskLight, DensityAndRadianceAreThoseOfTheDisk) {
    Pcg32 random(2);
    for (const double half : {0.1, 0.265, 40.0, 90.0}) {
        const SkyDiskLight shape = disk({-1, 0.2f, 0.4f}, half);
        const Light light = shape;
        const Frame frame = Frame::from_z(shape.direction);
        for (int i = 0; i < 1000; ++i) {
            const auto s = sample_light(light, Vec3(0), random.uniform2() * 0.999f, random);
            EXPECT_FLOAT_EQ(light_density(light, Vec3(0), s->direction, {}, {}), s->density);
            EXPECT_EQ(environment_radiance(light, Vec3(0), s->direction), s->radiance);
        }
        const auto at = [&](double degrees) {
            const auto angle = static_cast<float>(degrees * 3.14159265358979 / 180);
            return frame.to_world({0, std::sin(angle), std::cos(angle)});
        };
        EXPECT_GT(light_density(light, Vec3(0), at(0.99 * half), {}, {}), 0);
        EXPECT_EQ(light_density(light, Vec3(0), at(1.01 * half), {}, {}), 0);
        EXPECT_EQ(environment_radiance(light, Vec3(0), at(1.01 * half)), Rgb(0.0f));
    }
    EXPECT_TRUE(is_at_infinity(disk({0, 0, 1}, 1)));
    EXPECT_FALSE(is_point_like(disk({0, 0, 1}, 1)));
}

}  // namespace
}  // namespace wend
