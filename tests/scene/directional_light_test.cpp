#include <tests/sampling/verdicts.h>
#include <wend/sampling/warp.h>
#include <wend/scene/light.h>
#include <wend/scene/light_sampler.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>
#include <vector>

namespace wend {
namespace {

std::shared_ptr<const LightPicture> uneven_picture(int width, int height) {
    Image image(width, height);
    Pcg32 random(2);
    for (Rgb& pixel : image.pixels) {
        pixel = Rgb(random.uniform(), 0.5f, random.uniform() < 0.3f ? 3.0f : 0.1f);
    }
    return std::make_shared<const LightPicture>(image);
}

const AffineMap turned(Transform::rotate(-50, 1, 2, -1));

SpotLight spot() {
    return {{1, 2, 3}, {2, 3, 5}, turned, std::cos(0.3f), std::cos(0.7f)};
}
GoniometricLight goniometric() {
    return {{1, 2, 3}, {2, 3, 5}, turned, uneven_picture(8, 8)};
}
ProjectionLight projector() {
    return {{1, 2, 3}, {2, 3, 5}, turned, uneven_picture(6, 4), {0.9f, 0.6f}};
}

/// The intensity integrated over all directions.
template <class Directional>
Moments measured_power(const Directional& light, int channel) {
    Moments power;
    Pcg32 random(1);
    for (int i = 0; i < 400000; ++i) {
        power.add(4 * pi * intensity_towards(light, to_sphere(random.uniform2()))[channel]);
    }
    return power;
}

TEST(DirectionalLights, PowerIsTheIntegralOfTheirIntensity) {
    EXPECT_TRUE(agrees(measured_power(spot(), 1), static_cast<double>(3 * spread(spot())), 4));
    EXPECT_FALSE(agrees(measured_power(spot(), 1), static_cast<double>(3.1f * spread(spot())), 4));
    for (int c = 0; c < 3; ++c) {
        const Rgb of_picture = goniometric().intensity * spread(goniometric());
        EXPECT_TRUE(agrees(measured_power(goniometric(), c), static_cast<double>(of_picture[c]), 4));
        // The spread takes a pixel for its middle.
        const auto projected = static_cast<double>(projector().intensity[c] * spread(projector())[c]);
        EXPECT_NEAR(measured_power(projector(), c).mean(), projected, 0.03 * projected);
    }
}

TEST(DirectionalLights, PowerIsThatOfOtherProfilesToo) {
    SpotLight linear = spot();
    linear.is_linear = true;
    EXPECT_TRUE(agrees(measured_power(linear, 1), static_cast<double>(3 * spread(linear)), 4));
    EXPECT_FALSE(agrees(measured_power(linear, 1), static_cast<double>(3 * spread(spot())), 4));
    ProjectionLight even = projector();
    even.lights_plane_evenly = true;
    for (int c = 0; c < 3; ++c) {
        const auto projected = static_cast<double>(even.intensity[c] * spread(even)[c]);
        // The picture goes on as it is at its borders, over half a pixel.
        EXPECT_NEAR(measured_power(even, c).mean(), projected, 0.1 * projected);
    }
}

TEST(DirectionalLights, AWhitePictureInAConeIsASpot) {
    const SpotLight plain = spot();
    const auto white = std::make_shared<const LightPicture>(Image(64, 64, Rgb(1.0f)));
    ProjectionLight thrown{plain.position, plain.intensity, plain.light_from_world, white};
    thrown.cone = ProjectionLight::Cone{plain.cos_inner, plain.cos_outer, plain.is_linear};
    thrown.half_size = Vec2(std::sqrt(1 - plain.cos_outer * plain.cos_outer) / plain.cos_outer);
    Pcg32 random(3);
    for (int i = 0; i < 10000; ++i) {
        const Vec3 w = to_sphere(random.uniform2());
        EXPECT_NEAR(intensity_towards(thrown, w).g, intensity_towards(plain, w).g, 1e-5f);
    }
    EXPECT_NEAR(spread(thrown).g, spread(plain), 0.005f * spread(plain));
}

template <class Directional>
void expect_connection(const Directional& light, const Vec3& p) {
    Pcg32 random(1);
    const Vec3 d = p - light.position;
    const Rgb expected = intensity_towards(light, normalize(d)) / length_squared(d);
    const auto s = sample_light(light, p, {0.5f, 0.5f}, random);
    ASSERT_EQ(s.has_value(), !is_black(expected));
    if (s) {
        EXPECT_TRUE(s->point_like);
        EXPECT_EQ(s->density, 1);
        EXPECT_NEAR(s->radiance.g, expected.g, 1e-3f * expected.g);
        EXPECT_LT(length(p + s->direction * s->distance - light.position), 1e-4f);
    }
}

TEST(DirectionalLights, ConnectionsFollowTheIntensity) {
    Pcg32 random(3);
    for (int i = 0; i < 200; ++i) {
        const Vec3 p = Vec3(1, 2, 3) + to_sphere(random.uniform2()) * (0.5f + random.uniform());
        expect_connection(spot(), p);
        expect_connection(goniometric(), p);
        expect_connection(projector(), p);
    }
}

TEST(SpotLight, FallsOffSmoothlyBetweenItsAngles) {
    const SpotLight light{{0, 0, 0}, Rgb(1.0f), AffineMap(), std::cos(0.3f), std::cos(0.7f)};
    const auto at = [&](float angle) { return intensity_towards(light, {std::sin(angle), 0, std::cos(angle)}).g; };
    EXPECT_EQ(at(0), 1);
    EXPECT_EQ(at(0.29f), 1);
    EXPECT_NEAR(at(std::acos(0.5f * (std::cos(0.3f) + std::cos(0.7f)))), 0.5f, 1e-4f);
    EXPECT_EQ(at(0.71f), 0);
    EXPECT_EQ(at(pi), 0);
    const SpotLight sharp{{0, 0, 0}, Rgb(1.0f), AffineMap(), std::cos(0.5f), std::cos(0.5f)};
    EXPECT_EQ(intensity_towards(sharp, {0, 0, 1}).g, 1);
    EXPECT_EQ(intensity_towards(sharp, {1, 0, 0}).g, 0);
}

TEST(LightPicture, InterpolatesAndKeepsItsEdges) {
    Image image(2, 1);
    image.at(0, 0) = Rgb(1.0f);
    image.at(1, 0) = Rgb(3.0f);
    const LightPicture picture(image);
    EXPECT_EQ(picture.mean_colour(), Rgb(2.0f));
    EXPECT_EQ(picture.bilinear({0.5f, 0.5f}), Rgb(2.0f));
    EXPECT_EQ(picture.bilinear({0.25f, 0.9f}), Rgb(1.0f));
    EXPECT_EQ(picture.bilinear({-7, 0.1f}), Rgb(1.0f));
    EXPECT_EQ(picture.bilinear({1e30f, std::nanf("")}), Rgb(3.0f));
    EXPECT_EQ(picture.nearest({0.49f, 0.5f}), Rgb(1.0f));
    EXPECT_EQ(picture.nearest({1, 1}), Rgb(3.0f));
}

/// No place that a light reaches may be left out by the tree, and few others should cost connections.
TEST(DirectionalLights, TheTreeKnowsTheirCones) {
    const Light beside = PointLight{{-4, 0, 0}, Rgb(1.0f)};
    for (const Light& light : {Light(spot()), Light(goniometric()), Light(projector())}) {
        const std::vector<Light> lights = {beside, light};
        const TreeLightSampler sampler(lights, 10);
        Pcg32 random(4);
        int left_out = 0;
        for (int i = 0; i < 5000; ++i) {
            const Vec3 p = Vec3(1, 2, 3) + to_sphere(random.uniform2()) * (0.1f + 3 * random.uniform());
            const bool shines = sample_light(light, p, {0.5f, 0.5f}, random).has_value();
            const float probability = sampler.probability({p}, 1);
            EXPECT_TRUE(!shines || probability > 0) << p;
            left_out += probability == 0 ? 1 : 0;
        }
        EXPECT_GT(left_out, std::holds_alternative<GoniometricLight>(light) ? -1 : 3000);
    }
}

}  // namespace
}  // namespace wend
