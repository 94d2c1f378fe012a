// Lamps that shine differently in different directions.
#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>
#include <wend/scene/light.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace wend {
namespace {

EmissionProfile slats(float half_angle) {
    EmissionProfile profile;
    profile.kind = EmissionProfile::Kind::slats;
    profile.half_angle = half_angle;
    return profile;
}

/// Irradiance at p on a facet that faces +z.
Moments irradiance(const Light& light, const Vec3& p, int samples = 400000) {
    Moments moments;
    Pcg32 random(1);
    for (int i = 0; i < samples; ++i) {
        const auto s = sample_light(light, p, random.uniform2(), random);
        moments.add(s ? s->radiance.g * std::max(0.0f, s->direction.z) / s->density : 0);
    }
    return moments;
}

/// Above the origin, with its normal down or, flipped, up.
QuadricLight lamp(std::variant<Sphere, Disk> shape, float z, bool flip) {
    const Transform place = Transform::translate(0, 0, static_cast<double>(z));
    return make_quadric_light(std::make_shared<Quadric>(std::move(shape), place), place, flip, Rgb(3), false);
}

TEST(EmissionProfile, SlatsLetPassAsMuchAsWithoutThem) {
    for (const float half : {0.02f, 0.5f, 1.2f, 1.5f}) {
        const EmissionProfile profile = slats(half);
        double sum = 0;
        constexpr int steps = 20000;
        for (int i = 0; i < steps; ++i) {
            const double angle = (i + 0.5) / steps * double{half};
            const Vec3 w(static_cast<float>(std::sin(angle)), 0, static_cast<float>(std::cos(angle)));
            sum += double{profile.towards({0, 0, 1}, w)} * std::sin(2 * angle) * double{half} / steps;
        }
        EXPECT_NEAR(sum, 1, 0.01) << half;
        EXPECT_EQ(profile.towards({0, 0, 1}, {std::sin(half * 1.01f), 0, std::cos(half * 1.01f)}), 0) << half;
    }
}

TEST(EmissionProfile, BelowAWideLampBehindSlatsItIsAsBrightAsUnderASky) {
    // All directions that shine meet the lamp: pi L.
    QuadricLight light = lamp(Disk{0, 5}, 1, true);
    light.profile = std::make_shared<const EmissionProfile>(slats(1.0f));
    EXPECT_TRUE(test::is_within_one_percent(irradiance(light, {0, 0, 0}, 12000000), 3 * pi));
    // Where the slats hide the lamp there is nothing.
    EXPECT_EQ(irradiance(light, {5 + 1.6f, 0, 0}).mean(), 0);
    EXPECT_GT(irradiance(light, {5 + 1.5f, 0, 0}).mean(), 0);
}

TEST(EmissionProfile, FarFromASphereItsConeIsThatOfASpot) {
    QuadricLight light = lamp(Sphere{0.1f, -0.1f, 0.1f}, 20, false);
    EmissionProfile cone;
    cone.axis = {0, 0, -1};
    cone.cos_inner = std::cos(0.2f);
    cone.cos_outer = std::cos(0.5f);
    light.profile = std::make_shared<const EmissionProfile>(cone);
    const auto spot = [&](float x) {
        const float d2 = 400 + x * x, cosine = 20 / std::sqrt(d2);
        return 3 * pi * 0.01f * cone_falloff(cosine, cone.cos_inner, cone.cos_outer, false) * cosine / d2;
    };
    for (const float x : {0.0f, 6.0f, 8.0f}) {
        EXPECT_TRUE(test::is_within_one_percent(irradiance(light, {x, 0, 0}), static_cast<double>(spot(x)))) << x;
    }
    EXPECT_EQ(irradiance(light, {12, 0, 0}).mean(), 0);
}

TEST(EmissionProfile, WhatIsSeenOfALampIsWhatConnectionsFind) {
    QuadricLight light = lamp(Disk{0, 1}, 2, true);
    light.profile = std::make_shared<const EmissionProfile>(slats(0.7f));
    Pcg32 random(3);
    for (int i = 0; i < 100; ++i) {
        const auto s = sample_light(light, {0.3f, 0, 0}, random.uniform2(), random);
        if (s) {
            EXPECT_EQ(s->radiance, emitted_radiance(light, s->normal, s->uv, -s->direction));
        }
    }
}

}  // namespace
}  // namespace wend
