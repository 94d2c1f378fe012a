// Area lights that move, held to lights that stand where these are at a time.
#include "small_lights.h"
#include "transform_of.h"

#include <tests/scene/small_scene.h>
#include <wend/scene/light.h>
#include <wend/scene/moving_light.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <memory>
#include <utility>
#include <variant>

namespace wend {
namespace {

using test::quadric_light;
using test::radiance;
using test::transform_of;

/// By coordinate.
Vec3 max_of(const Vec3& a, const Vec3& b) {
    return {std::max(a.x, b.x), std::max(a.y, b.y), std::max(a.z, b.z)};
}

/// A triangle that moves, and what it is at a time.
TriangleLight moving_triangle(const std::array<Vec3, 3>& start, const std::array<Vec3, 3>& end,
                              std::shared_ptr<const Motion> placement, bool flip) {
    TriangleLight light = make_triangle_light(start[0], start[1], start[2], flip, radiance, false);
    light.motion = std::make_shared<const TriangleMotion>(TriangleMotion{end, std::move(placement), flip});
    return light;
}

// Twin: a lamp that stands where the other is at that time.
TEST(MovingAreaLights, AtEachTimeTheyAreAsIfTheyStoodThere) {
    const auto turning = std::make_shared<const Motion>(
        Transform::translate(-1, 0, 3),
        Transform::translate(1, 0.5, 2) * Transform::rotate(100, 1, 1, 0) * Transform::scale(2, 0.5, 1));
    const auto shifting = std::make_shared<const Motion>(Transform::translate(-1, 0, 3), Transform::translate(1, 2, 2));
    const std::array<Vec3, 3> start = {Vec3(-1, 0.5f, 0), Vec3(1.5f, -0.2f, -1), Vec3(0.3f, 1.5f, 1)};
    const std::array<Vec3, 3> end = {Vec3(-2, 0, 0.5f), Vec3(1, 1, -1), Vec3(0, 2.5f, -1)};
    Pcg32 random(4);
    const Vec3 p(0.2f, 0.1f, -2);
    const auto expect_alike = [&](const Light& moving, const Light& still, float time) {
        for (int i = 0; i < 50; ++i) {
            const Vec2 u = random.uniform2();
            const auto a = sample_light(moving, p, u, random, time), b = sample_light(still, p, u, random);
            ASSERT_EQ(a.has_value(), b.has_value());
            if (!a || abs_dot(b->normal, b->direction) < 0.02f) {
                continue;
            }
            EXPECT_LT(length(a->direction - b->direction), 1e-5f);
            EXPECT_NEAR(a->distance, b->distance, 1e-5f * b->distance);
            EXPECT_LT(length(a->normal - b->normal), 1e-4f);
            EXPECT_NEAR(a->density, b->density, 2e-3f * b->density);
            const Vec3 hit = p + a->direction * a->distance;
            EXPECT_NEAR(light_density(moving, p, a->direction, hit, a->normal, time), a->density, 4e-3f * a->density);
            // The extent over all times has it.
            const LightExtent extent = std::holds_alternative<TriangleLight>(moving)
                                           ? extent_over_time(std::get<TriangleLight>(moving))
                                           : extent_over_time(std::get<QuadricLight>(moving));
            EXPECT_LT(length(extent.box.max - max_of(extent.box.max, hit)), 1e-4f);
            EXPECT_LT(length(extent.box.min + max_of(-extent.box.min, -hit)), 1e-4f);
            EXPECT_TRUE(!extent.axis || length(*extent.axis - a->normal) < 1e-4f);
        }
    };
    for (const auto& motion : {turning, shifting, std::shared_ptr<const Motion>()}) {
        for (const float time : {0.0f, 0.3f, 0.71f, 1.0f}) {
            const Transform place = motion ? transform_of(motion->at(time).world_from_object) : Transform();
            for (const auto& ends : {start, end}) {
                for (const bool flip : {false, true}) {
                    std::array<Vec3, 3> now;
                    for (std::size_t k = 0; k < 3; ++k) {
                        now[k] = place.point(start[k] * (1 - time) + ends[k] * time);
                    }
                    expect_alike(moving_triangle(start, ends, motion, flip),
                                 make_triangle_light(now[0], now[1], now[2], flip, radiance, false), time);
                }
            }
            for (const std::variant<Sphere, Disk>& shape :
                 {std::variant<Sphere, Disk>(Sphere{}), std::variant<Sphere, Disk>(Sphere{1, -0.4f, 0.7f, 4}),
                  std::variant<Sphere, Disk>(Disk{0.2f, 1.5f, 0.3f})}) {
                Light moving = quadric_light(shape, Transform::scale(1, 0.8, 1.2));
                std::get<QuadricLight>(moving).motion = motion;
                expect_alike(moving, quadric_light(shape, place * Transform::scale(1, 0.8, 1.2)), time);
            }
        }
    }
}

// A lamp that shrinks to nothing shines no longer, and nothing about it is no number.
TEST(MovingAreaLights, WithoutAreaTheyAreDark) {
    const std::array<Vec3, 3> start = {Vec3(-1, 0, 2), Vec3(1, 0, 2), Vec3(0, 1, 2)};
    const Light light = moving_triangle(start, {Vec3(0, 0, 2), Vec3(0, 0, 2), Vec3(0, 0, 2)}, nullptr, true);
    Pcg32 random(1);
    EXPECT_TRUE(sample_light(light, Vec3(0), {0.3f, 0.3f}, random, 0));
    EXPECT_FALSE(sample_light(light, Vec3(0), {0.3f, 0.3f}, random, 1));
    EXPECT_EQ(light_density(light, Vec3(0), {0, 0, 1}, {0, 0, 2}, {0, 0, 1}, 1), 0);
}

}  // namespace
}  // namespace wend
