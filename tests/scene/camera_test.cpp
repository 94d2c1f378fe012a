#include <tests/sampling/verdicts.h>
#include <tests/support/chi_square_sphere.h>
#include <wend/core/random.h>
#include <wend/scene/camera.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace wend {
namespace {

constexpr int picture_width = 40, picture_height = 20;
const Vec2 picture_middle(picture_width / 2.0f, picture_height / 2.0f), any_lens(0.3f, 0.8f);
const Vec3 eye(1, 2, 3), seen_place(4, 3, -2);

Transform world_from_camera() {
    return Transform::look_at(Imath::V3d(eye), Imath::V3d(seen_place), {0, 1, 0}).inverse();
}

/// 60 degrees from left to right.
PerspectiveCamera perspective() {
    const float x = std::tan(pi / 6);
    return {{-x, x, -x / 2, x / 2}};
}

Camera camera(const Camera::Kind& kind) {
    return Camera(kind, world_from_camera(), picture_width, picture_height);
}

TEST(PerspectiveCamera, LooksAtItsTarget) {
    const Ray ray = camera(perspective()).ray(picture_middle, any_lens);
    EXPECT_LT(length(ray.origin - eye), 1e-6f);
    EXPECT_LT(length(ray.direction - normalize(seen_place - eye)), 1e-6f);
}

TEST(PerspectiveCamera, EdgesSpanTheFieldOfView) {
    const Camera c = camera(perspective());
    const auto angle = [&](const Vec2& a, const Vec2& b) {
        return std::acos(dot(c.ray(a, any_lens).direction, c.ray(b, any_lens).direction));
    };
    EXPECT_NEAR(angle({0, picture_middle.y}, {picture_width, picture_middle.y}), pi / 3, 1e-5f);
    EXPECT_NEAR(angle({picture_middle.x, 0}, {picture_middle.x, picture_height}), 2 * std::atan(std::tan(pi / 6) / 2),
                1e-5f);
}

TEST(PerspectiveCamera, TheFirstPixelIsUpAndLeft) {
    // Looking along +z with y up in a left-handed space, x is on the right.
    const Camera c(perspective(), Transform(), picture_width, picture_height);
    const Vec3 corner = c.ray({0, 0}, any_lens).direction;
    EXPECT_LT(corner.x, 0);
    EXPECT_GT(corner.y, 0);
    EXPECT_GT(corner.z, 0);
}

TEST(PerspectiveCamera, RaysOfOneFilmPointMeetInTheFocalPlane) {
    PerspectiveCamera lens = perspective();
    lens.lens_radius = 0.2f;
    lens.focal_distance = 5;
    const Camera c = camera(lens), pinhole = camera(perspective());
    const Vec3 forward = normalize(seen_place - eye);
    Pcg32 random(1);
    test::Uniformity radii;
    for (int i = 0; i < 10000; ++i) {
        const Vec2 film(picture_width * random.uniform(), picture_height * random.uniform());
        const Ray ray = c.ray(film, random.uniform2()), central = pinhole.ray(film, any_lens);
        const Vec3 focus = central.at(5 / dot(central.direction, forward));
        EXPECT_LT(length(ray.at(dot(focus - ray.origin, ray.direction)) - focus), 1e-5f);
        const Vec3 from_centre = ray.origin - eye;
        EXPECT_NEAR(dot(from_centre, forward), 0, 1e-6f);
        radii.add(length_squared(from_centre) / sqr(0.2f));
    }
    EXPECT_GE(radii.p_value(), test::passing);
}

TEST(OrthographicCamera, RaysAreParallelAndSpreadOverTheScreen) {
    const Camera c(OrthographicCamera{{-4, 4, -2, 2}}, Transform(), picture_width, picture_height);
    const Ray corner = c.ray({0, 0}, any_lens), centre = c.ray(picture_middle, any_lens);
    EXPECT_EQ(corner.direction, Vec3(0, 0, 1));
    EXPECT_EQ(corner.origin, Vec3(-4, 2, 0));
    EXPECT_EQ(centre.origin, Vec3(0, 0, 0));
}

TEST(OrthographicCamera, RaysThroughALensMeetInTheFocalPlane) {
    const Camera c(OrthographicCamera{{-4, 4, -2, 2}, 0.1f, 3}, Transform(), picture_width, picture_height);
    Pcg32 random(2);
    for (int i = 0; i < 100; ++i) {
        const Ray ray = c.ray({10, 5}, random.uniform2());
        EXPECT_LT(length(ray.at(3 / ray.direction.z) - Vec3(-2, 1, 3)), 1e-5f);
    }
}

test::SphereTest sphere_test(SphericalCamera::Mapping mapping, const test::DirectionDensity& density) {
    const Camera c(SphericalCamera{mapping}, Transform(), picture_width, picture_height);
    return test::chi_square_sphere(
        [&](Vec2 u) {
            return c.ray({u.x * picture_width, u.y * picture_height}, any_lens).direction;
        },
        density);
}

/// A row vector times a matrix, divided by its last number.
Vec3 times(const Vec3& p, const std::array<float, 16>& m) {
    std::array<float, 4> out{};
    const std::array<float, 4> in{p.x, p.y, p.z, 1};
    for (std::size_t row = 0; row < 4; ++row) {
        for (std::size_t column = 0; column < 4; ++column) {
            out[column] += in[row] * m[4 * row + column];
        }
    }
    return Vec3(out[0], out[1], out[2]) / out[3];
}

TEST(ViewMatrices, LeadPointsOfRaysBackToTheirPlaceOnTheFilm) {
    const PerspectiveCamera shifted{{-0.5f, 0.9f, -0.2f, 0.6f}};
    const OrthographicCamera parallel{{-2, 3, -1, 2}};
    for (const Camera::Kind& kind : {Camera::Kind(perspective()), Camera::Kind(shifted), Camera::Kind(parallel)}) {
        const Camera c = camera(kind);
        const auto view = c.view_matrices();
        ASSERT_TRUE(view);
        for (const Vec2& film : {Vec2(0, 0), Vec2(picture_width, picture_height), Vec2(7, 15)}) {
            const Vec3 p = c.ray(film, {0.5f, 0.5f}).at(3);
            const Vec3 there = times(p, view->ndc_from_world);
            EXPECT_NEAR(there.x, film.x / picture_width, 1e-4f);
            EXPECT_NEAR(there.y, film.y / picture_height, 1e-4f);
            EXPECT_LT(length(times(p, view->camera_from_world) - world_from_camera().inverse().point(p)), 1e-4f);
        }
    }
    EXPECT_FALSE(camera(SphericalCamera{}).view_matrices());
}

TEST(SphericalCamera, EqualAreaCoversTheSphereUniformly) {
    EXPECT_TRUE(test::follows_density(
        sphere_test(SphericalCamera::Mapping::equal_area, [](const Vec3&) { return inv_4pi; }), "camera"));
    EXPECT_LT(
        sphere_test(SphericalCamera::Mapping::equirectangular, [](const Vec3&) { return inv_4pi; }).result.p_value,
        test::failing);
}

TEST(SphericalCamera, EqualAreaIsContinuousOverItsEdges) {
    // The pixel filter may ask for points a little outside.
    const Camera c(SphericalCamera{SphericalCamera::Mapping::equal_area}, Transform(), 100, 100);
    for (float s = 1; s < 100; s += 7) {
        const Vec2 pairs[4][2] = {
            {{s, -0.1f}, {s, 0.1f}}, {{s, 100.1f}, {s, 99.9f}}, {{-0.1f, s}, {0.1f, s}}, {{100.1f, s}, {99.9f, s}}};
        for (const auto& [outside, inside] : pairs) {
            EXPECT_LT(length(c.ray(outside, any_lens).direction - c.ray(inside, any_lens).direction), 0.05f) << outside;
        }
    }
}

TEST(SphericalCamera, EquirectangularIsLongitudeAndLatitude) {
    const Camera c(SphericalCamera{SphericalCamera::Mapping::equirectangular}, Transform(), picture_width,
                   picture_height);
    Pcg32 random(3);
    for (int i = 0; i < 1000; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 w = c.ray({u.x * picture_width, u.y * picture_height}, any_lens).direction;
        EXPECT_NEAR(length(w), 1, 1e-5f);
        EXPECT_NEAR(w.y, std::cos(pi * u.y), 1e-5f);
        EXPECT_NEAR(w.x, std::sin(pi * u.y) * std::cos(2 * pi * u.x), 1e-5f);
    }
}

}  // namespace
}  // namespace wend
