// What rays of a time find in scenes that move.
#include "transform_of.h"

#include <tests/scene/small_scene.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace wend {
namespace {

using test::transform_of;

/// What surfaces can be.
std::vector<Shape> unit_shapes() {
    TriangleMesh smooth = test::square(0.2f);
    smooth.normals = {normalize(Vec3(-1, -1, 3)), normalize(Vec3(1, -1, 3)), normalize(Vec3(1, 1, 3)),
                      normalize(Vec3(-1, 1, 3))};
    smooth.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    return {smooth, Quadric(Sphere{}, Transform::translate(0.2, 0, 0)), Quadric(Disk{}, Transform()),
            CylinderShell(Cylinder{}, Transform::scale(0.8, 0.8, 1))};
}

/// A shape that is placed by a motion.
SceneDescription placed(const Shape& shape, const Motion& motion) {
    SceneDescription scene = test::two_materials();
    scene.surfaces.push_back({shape, 0});
    scene.objects.push_back({{0}});
    scene.instances.push_back({0, motion});
    return scene;
}

const std::vector<std::pair<const char*, Motion>>& motions() {
    static const std::vector<std::pair<const char*, Motion>> all = {
        {"shift", {Transform::translate(-1, 0, 0), Transform::translate(1, 0.5, 0)}},
        {"turn", {Transform::rotate(-40, 1, 2, 3), Transform::rotate(110, 3, 1, -1)}},
        {"growth", {Transform::scale(0.5, 0.5, 0.5), Transform::scale(1, 1.5, 1)}},
        {"all",
         {Transform::translate(0, -1, 0) * Transform::rotate(10, 0, 1, 0) * Transform::scale(-1, 1, 1),
          Transform::translate(0.5, 1, 0.5) * Transform::rotate(150, 1, 1, 0) * Transform::scale(-0.7, 1, 1.2)}},
    };
    return all;
}

// Twin: a scene that stands still where the motion is at that time.
TEST(MovingScene, AtEachTimeItIsAsIfItStoodThere) {
    Pcg32 random(3);
    for (const Shape& shape : unit_shapes()) {
        for (const auto& [name, motion] : motions()) {
            SCOPED_TRACE(name);
            const Scene moving(placed(shape, motion));
            ASSERT_TRUE(moving.is_moving());
            int hits = 0;
            for (int k = 0; k < 12; ++k) {
                const float time = k == 0 ? 0.0f : k == 1 ? 1.0f : random.uniform();
                const Scene still(placed(shape, transform_of(motion.at(time).world_from_object)));
                ASSERT_FALSE(still.is_moving());
                for (int i = 0; i < 400; ++i) {
                    const Vec3 from = to_sphere(random.uniform2()) * 4.0f;
                    const Vec3 w = normalize(to_sphere(random.uniform2()) * 0.7f - from);
                    const Ray ray{from, w, time};
                    const auto a = moving.intersect(ray), b = still.intersect(ray);
                    if (a.has_value() != b.has_value()) {
                        continue;  // rounding at an outline
                    }
                    EXPECT_EQ(moving.is_occluded(ray, 10), a.has_value());
                    if (!a) {
                        continue;
                    }
                    ++hits;
                    EXPECT_EQ(a->time, time);
                    // A ray along a surface is less exact.
                    const float exact = 1e-5f / std::max(0.02f, std::abs(dot(b->normal, w)));
                    EXPECT_NEAR(a->distance, b->distance, 4 * exact);
                    EXPECT_LT(length(a->position - b->position), 4 * exact);
                    EXPECT_LT(length(a->normal - b->normal), 10 * exact);
                    EXPECT_LT(length(a->shading.n - b->shading.n), 10 * exact);
                    EXPECT_LT(length(a->shading.s - b->shading.s), 100 * exact);
                    EXPECT_LT((a->uv - b->uv).length(), 40 * exact);
                    const Vec3 along = b->shading.s * 0.1f;
                    EXPECT_LT(length(moving.normal_change(*a, along) - still.normal_change(*b, along)), 10 * exact);
                    // What leaves the surface keeps the time.
                    EXPECT_EQ(TracedRay(ray).leave(*a, a->normal).time, time);
                }
            }
            EXPECT_GT(hits, 500);
        }
    }
}

/// A mesh that becomes another, and what it is between.
TriangleMesh between(TriangleMesh start, const TriangleMesh& end, float time) {
    for (std::size_t i = 0; i < start.positions.size(); ++i) {
        start.positions[i] = start.positions[i] * (1 - time) + end.positions[i] * time;
        start.normals[i] = start.normals[i] * (1 - time) + end.normals[i] * time;
    }
    return start;
}

TriangleMesh changing(TriangleMesh start, const TriangleMesh& end) {
    start.end_positions = end.positions;
    start.end_normals = end.normals;
    return start;
}

SceneDescription standing(const Shape& shape) {
    SceneDescription scene = test::two_materials();
    test::add(scene, shape, 0);
    return scene;
}

// Twins: the mesh as it is then, and the mesh as it is at the start.
TEST(MovingScene, AtEachTimeAMeshIsWhatItHasBecome) {
    TriangleMesh start = test::square(0.2f), end = test::square(-0.4f);
    start.normals = {normalize(Vec3(-1, -1, 3)), normalize(Vec3(1, -1, 3)), normalize(Vec3(1, 1, 3)),
                     normalize(Vec3(-1, 1, 3))};
    start.uvs = {{0, 0}, {1, 0}, {1, 1}, {0, 1}};
    end.normals = {normalize(Vec3(1, -1, 2)), normalize(Vec3(1, 0, 3)), normalize(Vec3(0, 1, 2)), Vec3(0, 0, 1)};
    end.positions[0] = {-2, 0.3f, 0.5f};
    end.positions[2] = {0.5f, 1.5f, 0};
    const Scene moving(standing(changing(start, end)));
    ASSERT_TRUE(moving.is_moving());
    EXPECT_LE(moving.bounds().min.x, -2);
    // As part of what moves, too.
    const Motion shift(Transform(), Transform::translate(0, 0, 1));
    const Scene moving_within(placed(changing(start, end), shift));
    Pcg32 random(5);
    int hits = 0, differ = 0;
    for (int k = 0; k < 12; ++k) {
        const float time = k == 0 ? 0.0f : k == 1 ? 1.0f : random.uniform();
        const Scene still(standing(between(start, end, time)));
        const Scene still_within(placed(between(start, end, time), Transform::translate(0, 0, double{time})));
        const Scene at_start(standing(between(start, end, 0)));
        for (int i = 0; i < 400; ++i) {
            const Vec3 from = to_sphere(random.uniform2()) * 4.0f;
            const Vec3 w = normalize(to_sphere(random.uniform2()) * 0.7f - from);
            const Ray ray{from, w, time};
            for (const auto& [a_scene, b_scene] : {std::pair(&moving, &still), {&moving_within, &still_within}}) {
                const auto a = a_scene->intersect(ray), b = b_scene->intersect(ray);
                if (!a || !b) {
                    continue;
                }
                ++hits;
                const float exact = 1e-5f / std::max(0.02f, std::abs(dot(b->normal, w)));
                EXPECT_LT(length(a->position - b->position), 4 * exact);
                EXPECT_LT(length(a->normal - b->normal), 10 * exact);
                EXPECT_LT(length(a->shading.n - b->shading.n), 20 * exact);
                EXPECT_LT((a->uv - b->uv).length(), 40 * exact);
                const Vec3 along = b->shading.s * 0.1f;
                EXPECT_LT(length(a_scene->normal_change(*a, along) - b_scene->normal_change(*b, along)), 40 * exact);
            }
            const auto a = moving.intersect(ray), b = at_start.intersect(ray);
            differ += a.has_value() != b.has_value() || (a && length(a->position - b->position) > 1e-3f);
        }
    }
    EXPECT_GT(hits, 500);
    EXPECT_GT(differ, 200);
}

// A card of width 2, whose right edge goes from x = 1 to x = 3: at x it is there for 1 - (x - 1) / 2 of the time.
TEST(MovingScene, WhatAChangingMeshCoversIsWhatItCoversOverTime) {
    TriangleMesh card = test::square(), wide = test::square();
    for (Vec3& p : wide.positions) {
        p.x = p.x > 0 ? 3.0f : p.x;
    }
    card.end_positions = wide.positions;
    const Scene scene(standing(card));
    const int times = 1000;
    for (const float x : {0.5f, 1.25f, 1.75f, 2.5f}) {
        int covered = 0;
        for (int i = 0; i < times; ++i) {
            covered += scene.is_occluded(Ray{{x, 0.1f, 1}, {0, 0, -1}, (static_cast<float>(i) + 0.5f) / times}, 5);
        }
        EXPECT_NEAR(covered, x < 1 ? times : times * (1 - (x - 1) / 2), 1.5) << x;
    }
}

TEST(MovingScene, TheTimeMatters) {
    const Scene scene(placed(test::square(), motions()[0].second));
    const auto hits = [&](float x, float time) {
        return scene.intersect(Ray{{x, 0, 1}, {0, 0, -1}, time}).has_value();
    };
    EXPECT_TRUE(hits(-1.9f, 0));
    EXPECT_FALSE(hits(-1.9f, 1));
    EXPECT_FALSE(hits(1.9f, 0));
    EXPECT_TRUE(hits(1.9f, 1));
    EXPECT_TRUE(hits(-0.9f, 0.5f));
    EXPECT_FALSE(hits(-1.1f, 0.51f));
}

TEST(MovingScene, BoundsHoldAllTimes) {
    const Scene scene(placed(test::square(), Motion(Transform::translate(-5, 0, 0),
                                                    Transform::translate(7, 0, 0) * Transform::rotate(180, 0, 1, 0))));
    EXPECT_LE(scene.bounds().min.x, -6 + 1e-4f);
    EXPECT_GE(scene.bounds().max.x, 8 - 1e-4f);
    // Half way it stands on edge.
    EXPECT_GE(scene.bounds().max.z - scene.bounds().min.z, 2 - 1e-3f);
}

constexpr MediumId fog = 0, air = 1;

/// A ball of fog that moves along x from -3 to 3, in air or in nothing.
SceneDescription with_ball(bool in_air) {
    SceneDescription scene = test::two_materials();
    scene.media.assign(2, HomogeneousMedium{Rgb(1), Rgb(1), Rgb(0), PhaseFunction()});
    scene.surfaces.push_back({Quadric(Sphere{}, Transform()), 1, fog, in_air ? air : vacuum});
    scene.objects.push_back({{0}});
    scene.instances.push_back({0, Motion(Transform::translate(-3, 0, 0), Transform::translate(3, 0, 0))});
    scene.camera = Camera(PerspectiveCamera{}, Transform(), 2, 2);
    if (in_air) {
        test::add(scene, Quadric(Sphere{10, -10, 10}, Transform()), 1).interior = air;
        scene.camera_medium = air;
    }
    return scene;
}

bool is_in_ball(const Vec3& centre, const Vec3& p) {
    return length(p - centre) < 1;
}

TEST(MovingScene, WalksBeginInWhatMovesAroundTheCamera) {
    for (const bool in_air : {false, true}) {
        const Scene scene(with_ball(in_air));
        Pcg32 random(1);
        int inside = 0;
        for (int i = 0; i < 2000; ++i) {
            const float time = random.uniform();
            const Vec3 centre(-3 + 6 * time, 0, 0);
            const MediumId outside = in_air ? air : vacuum;
            TracedRay ray = Ray{{0, 0, 0}, to_sphere(random.uniform2()), time};
            MediumState state = scene.medium_around(ray);
            inside += state.id == fog;
            while (const auto hit = scene.intersect(ray)) {
                ASSERT_EQ(state.id, is_in_ball(centre, ray.at(0.5f * hit->distance)) ? fog : outside) << time;
                state = scene.medium_beyond(*hit, ray.direction, state);
                ray.pass(*hit);
            }
            ASSERT_EQ(state.id, vacuum);
        }
        // A third of the time.
        EXPECT_NEAR(inside, 2000 / 3.0, 120);
    }
}

/// A box of this half width around (x, 0, 0).
std::vector<Vec3> corners_of_box(float x, float half) {
    std::vector<Vec3> corners;
    for (int i = 0; i < 8; ++i) {
        const auto side = [&](int axis) { return (i >> axis & 1) != 0 ? half : -half; };
        corners.push_back({x + side(0), side(1), side(2)});
    }
    return corners;
}

TEST(MovingScene, WalksBeginInWhatGrowsAroundTheCamera) {
    SceneDescription description = test::two_materials();
    description.media.assign(1, HomogeneousMedium{Rgb(1), Rgb(1), Rgb(0), PhaseFunction()});
    TriangleMesh box;
    box.positions = corners_of_box(-2, 1);
    box.end_positions = corners_of_box(0, 3);
    box.indices = {0, 2, 3, 0, 3, 1, 4, 5, 7, 4, 7, 6, 0, 1, 5, 0, 5, 4,
                   2, 6, 7, 2, 7, 3, 0, 4, 6, 0, 6, 2, 1, 3, 7, 1, 7, 5};
    test::add(description, box, 1).interior = fog;
    description.camera = Camera(PerspectiveCamera{}, Transform(), 2, 2);
    const Scene scene(std::move(description));
    // Its right side goes from -1 to 3, and passes the camera after a quarter of the time.
    Pcg32 random(2);
    for (const float time : {0.0f, 0.1f, 0.24f, 0.26f, 0.6f, 1.0f}) {
        const TracedRay ray = Ray{{0, 0, 0}, to_sphere(random.uniform2()), time};
        EXPECT_EQ(scene.medium_around(ray).id, time > 0.25f ? fog : vacuum) << time;
    }
}

TEST(MovingScene, ACameraMovesOutOfWhatItStartsIn) {
    SceneDescription description = test::two_materials();
    description.media.assign(1, HomogeneousMedium{Rgb(1), Rgb(1), Rgb(0), PhaseFunction()});
    test::add(description, Quadric(Sphere{}, Transform()), 1).interior = fog;
    description.camera =
        Camera(PerspectiveCamera{}, Motion(Transform(), Transform::translate(2, 0, 0)), 2, 2, Shutter{0, 1, 0, 1});
    description.camera_medium = fog;
    const Scene scene(std::move(description));
    EXPECT_TRUE(scene.is_moving());
    for (const float time : {0.0f, 0.2f, 0.49f, 0.51f, 0.9f, 1.0f}) {
        const Ray ray = scene.camera().ray({0.3f, 1.2f}, {0.5f, 0.5f}, time);
        EXPECT_EQ(ray.time, time);
        EXPECT_EQ(scene.medium_around(ray).id, time < 0.5f ? fog : vacuum) << time;
    }
}

TEST(Shutter, TimesBeforeTheStartAndAfterTheEndAreThose) {
    const Shutter plain;
    EXPECT_EQ(plain.time(0.25f), 0.25f);
    const Shutter late{1, 3, 2, 4};
    EXPECT_EQ(late.time(0), 0);
    EXPECT_EQ(late.time(0.4f), 0);
    EXPECT_FLOAT_EQ(late.time(0.75f), 0.25f);
    EXPECT_FLOAT_EQ(late.time(1), 0.5f);
    const Shutter after{5, 6, 0, 1};
    EXPECT_EQ(after.time(0.5f), 1);
    const Shutter sudden{0, 1, 0.5f, 0.5f};
    EXPECT_EQ(sudden.time(0.5f), 0);
    EXPECT_EQ(sudden.time(0.51f), 1);
}

}  // namespace
}  // namespace wend
