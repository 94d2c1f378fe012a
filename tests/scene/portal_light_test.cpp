#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/sampling/warp.h>
#include <wend/scene/light.h>
#include <wend/scene/portal_light.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>

namespace wend {
namespace {

/// A rectangle of 1 x 2 at z = 1, which shines on what is below, turned in its plane.
const std::array<Vec3, 4> corners{Vec3(0, 0, 1), Vec3(-0.6f, 0.8f, 1), Vec3(1, 2, 1), Vec3(1.6f, 1.2f, 1)};

PortalLight uneven_portal() {
    Image sky(16, 16);
    Pcg32 random(3);
    for (Rgb& pixel : sky.pixels) {
        pixel = Rgb(random.uniform(), random.uniform(), random.uniform() < 0.3f ? 9.0f : 0.1f);
    }
    return {sky, 2, Transform::rotate(70, 1, -1, 2), corners};
}

PortalLight even_portal() {
    return {Image(1, 1, Rgb(1, 2, 3)), 2, Transform(), corners};
}

const Vec3 below(0.9f, 0.4f, -0.3f);

/// Irradiance of radiance 1 on a facet below that faces the rectangle's plane, by Lambert's formula.
double irradiance_of_rectangle(const Vec3& p) {
    double sum = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        const Vec3 a = normalize(corners[i] - p), b = normalize(corners[(i + 1) % 4] - p);
        sum += std::acos(static_cast<double>(dot(a, b))) * static_cast<double>(normalize(cross(a, b)).z);
    }
    return 0.5 * std::abs(sum);
}

TEST(PortalLight, EvenIrradianceIsKnown) {
    const PortalLight portal = even_portal();
    Moments irradiance;
    Pcg32 random(1);
    for (int i = 0; i < 400000; ++i) {
        const auto s = portal.sample(below, random.uniform2());
        ASSERT_TRUE(s);
        irradiance.add(s->radiance.g * s->direction.z / s->density);
    }
    EXPECT_TRUE(test::is_within_one_percent(irradiance, 4 * irradiance_of_rectangle(below)));
}

TEST(PortalLight, SamplesFollowTheDensity) {
    const Light light = PortalInfiniteLight{std::make_shared<const PortalLight>(uneven_portal())};
    test::SphereTestOptions options;
    options.samples = 50000;
    options.cosine_cells = 10;
    options.azimuth_cells = 16;
    const auto drawn = [&](Pcg32& random) -> std::optional<Vec3> {
        const auto s = sample_light(light, below, random.uniform2(), random);
        return s ? std::optional(s->direction) : std::nullopt;
    };
    const auto density_from = [&light](const Vec3& p) {
        return [&light, p](const Vec3& w) { return static_cast<double>(light_density(light, p, w, Vec3(0), Vec3(0))); };
    };
    EXPECT_TRUE(test::follows_density(test::chi_square_sphere(drawn, density_from(below), options), "portal_light"));
    const auto elsewhere = density_from(below + Vec3(0.1f, 0, 0));
    EXPECT_LT(test::chi_square_sphere(drawn, elsewhere, options).result.p_value, test::failing);
}

TEST(PortalLight, SamplesAgreeWithTheRadianceAndDensityOfTheirDirection) {
    const PortalLight portal = uneven_portal();
    Pcg32 random(5);
    int differ = 0;
    for (int i = 0; i < 10000; ++i) {
        const float x = random.uniform(), y = random.uniform();
        const Vec3 p = below + Vec3(x, y, -random.uniform());
        const auto s = portal.sample(p, random.uniform2());
        ASSERT_TRUE(s);
        EXPECT_NEAR(length(s->direction), 1, 1e-5f);
        const bool same = portal.radiance(p, s->direction) == s->radiance &&
                          std::abs(portal.density(p, s->direction) / s->density - 1) < 1e-3f;
        differ += same ? 0 : 1;
    }
    // Rounding may move a sample across the edge of a pixel or of the window.
    EXPECT_LT(differ, 20);
}

TEST(PortalLight, ShinesThroughTheRectangleAlone) {
    const PortalLight portal = even_portal();
    const auto through = [&](float a, float b) {
        const Vec3 to = corners[0] + (corners[1] - corners[0]) * a + (corners[3] - corners[0]) * b;
        return portal.radiance(below, normalize(to - below)).r;
    };
    EXPECT_EQ(through(0.01f, 0.01f), 2);
    EXPECT_EQ(through(0.99f, 0.99f), 2);
    EXPECT_EQ(through(0.99f, 0.01f), 2);
    EXPECT_EQ(through(1.01f, 0.5f), 0);
    EXPECT_EQ(through(0.5f, -0.01f), 0);
    // From the other side, and from within its plane.
    const Vec3 above(0.5f, 1, 2), within(0.5f, 1, 1);
    EXPECT_EQ(portal.radiance(above, {0, 0, -1}).r, 0);
    EXPECT_EQ(portal.radiance(above, {0, 0, 1}).r, 0);
    EXPECT_FALSE(portal.sample(above, {0.5f, 0.5f}));
    EXPECT_FALSE(portal.sample(within, {0.5f, 0.5f}));
    EXPECT_EQ(portal.density(above, {0, 0, 1}), 0);
}

TEST(PortalLight, PowerIsThatOfItsOpening) {
    EXPECT_NEAR(even_portal().power().r / (2 * 2 * pi), 1, 3e-3f);
}

}  // namespace
}  // namespace wend
