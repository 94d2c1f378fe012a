#include <wend/core/vector.h>
#include <wend/scene/camera.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

using Mapping = Panorama::Mapping;

Panorama panorama_of(Mapping mapping, const ScreenWindow& screen) {
    Panorama panorama;
    panorama.mapping = mapping;
    panorama.screen = screen;
    return panorama;
}

/// The angle to the axis, and that around it from x, of what a film point sees.
Vec2 angles(const Panorama& camera, const Vec2& p) {
    const auto d = camera.direction(p);
    EXPECT_TRUE(d) << p;
    if (!d) {
        return {};
    }
    EXPECT_NEAR(length(*d), 1, 1e-5f);
    return {std::acos(d->z), std::atan2(d->y, d->x)};
}

Camera camera(const Panorama& panorama) {
    return Camera(PanoramicCamera{std::make_shared<const Panorama>(panorama)}, Transform(), 100, 100);
}

Vec2 share_of(float x, float y) {
    return {0.5f + 0.5f * x, 0.5f - 0.5f * y};
}

TEST(Panorama, FisheyesSeeTheirAngleAtEachDistance) {
    constexpr float half_pi = pi / 2;
    Panorama equidistant = panorama_of(Mapping::equidistant, {-half_pi, half_pi, -half_pi, half_pi});
    Panorama equisolid = panorama_of(Mapping::equisolid, {-1.5f, 1.5f, -1.5f, 1.5f});
    Panorama polynomial = panorama_of(Mapping::polynomial, {-10, 10, -10, 10});
    polynomial.coefficients = {0.01f, 0.1f, 0.002f, -1e-4f, 1e-6f};
    for (const float r : {0.0f, 0.1f, 0.5f, 0.9f}) {
        for (const float around : {0.3f, 2.0f, -1.0f}) {
            const Vec2 p = share_of(r * std::cos(around), r * std::sin(around));
            EXPECT_NEAR(angles(equidistant, p).x, half_pi * r, 1e-3f);
            EXPECT_NEAR(2 * std::sin(0.5f * angles(equisolid, p).x), 1.5f * r, 1e-3f);
            const double d = 10 * double{r};
            EXPECT_NEAR(angles(polynomial, p).x,
                        0.01 + 0.1 * d + 0.002 * d * d - 1e-4 * d * d * d + 1e-6 * std::pow(d, 4), 1e-3);
            if (r > 0) {
                EXPECT_NEAR(angles(equisolid, p).y, around, 1e-3f);
            }
        }
    }
}

TEST(Panorama, FilmIsDarkBeyondTheFieldOfView) {
    Panorama fisheye = panorama_of(Mapping::equisolid, {-3, 3, -3, 3});
    EXPECT_FALSE(fisheye.direction(share_of(0.7f, 0))) << "no angle is that far from the middle";
    fisheye.largest_angle = pi / 3;
    EXPECT_TRUE(fisheye.direction(share_of(0.33f, 0)));
    EXPECT_FALSE(fisheye.direction(share_of(0.34f, 0)));
    EXPECT_EQ(camera(fisheye).ray({99, 50}, {0.5f, 0.5f}).weight, 0);
    EXPECT_EQ(camera(fisheye).ray({50, 50}, {0.5f, 0.5f}).weight, 1);
    EXPECT_FALSE(panorama_of(Mapping::mirror_ball, {}).direction(share_of(0.8f, 0.8f)));
}

TEST(Panorama, OthersFollowTheirFormulas) {
    const auto expect_at = [](const Panorama& camera, const Vec2& p, const Vec3& expected) {
        const auto d = camera.direction(p);
        ASSERT_TRUE(d);
        EXPECT_LT(length(*d - normalize(expected)), 1e-5f) << *d;
    };
    // A quarter to the right, and up by 45 degrees.
    const Panorama around = panorama_of(Mapping::equirectangular, {-pi, pi, -pi / 2, pi / 2});
    expect_at(around, share_of(0.5f, 0), {1, 0, 0});
    expect_at(around, share_of(0, 0.5f), {0, 1, 1});
    const Panorama cylinder = panorama_of(Mapping::cylindrical, {-pi, pi, -2, 2});
    expect_at(cylinder, share_of(-0.5f, 0.25f), {-1, 0.5f, 0});
    const Panorama face = panorama_of(Mapping::cube_face, {-pi / 4, pi / 4, -pi / 4, pi / 4});
    expect_at(face, share_of(1, -1), {1, -1, 1});
    expect_at(face, share_of(0.5f, 0), {std::tan(pi / 8), 0, 1});
    // A ball reflects at its normal.
    const Panorama ball = panorama_of(Mapping::mirror_ball, {});
    expect_at(ball, share_of(0, 0), {0, 0, 1});
    expect_at(ball, share_of(std::sqrt(0.5f), 0), {1, 0, 0});
}

TEST(Panorama, RaysThroughItsLensMeetAtTheFocalDistance) {
    Panorama fisheye = panorama_of(Mapping::equidistant, {-2, 2, -2, 2});
    const Vec2 film(80, 30);
    const Vec3 focus = camera(fisheye).ray(film, {0.5f, 0.5f}).at(3);
    fisheye.lens_radius = 0.2f;
    fisheye.focal_distance = 3;
    for (const Vec2& lens : {Vec2(0.1f, 0.9f), Vec2(0.7f, 0.2f), Vec2(0.9f, 0.95f)}) {
        const Ray ray = camera(fisheye).ray(film, lens);
        EXPECT_GT(length(ray.origin), 0);
        EXPECT_NEAR(dot(ray.origin, focus), 0, 1e-5f);
        EXPECT_LT(length(ray.at(length(focus - ray.origin)) - focus), 1e-5f);
    }
}

}  // namespace
}  // namespace wend
