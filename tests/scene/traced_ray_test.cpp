#include <tests/scene/small_scene.h>
#include <tests/support/scenes.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace wend {
namespace {

struct Body {
    std::string name;
    Transform place;
};

/// Sizes and distances from the origin over seven orders of magnitude, and a stretched body.
const std::vector<Body>& bodies() {
    static const std::vector<Body> all = {
        {"unit", Transform()},
        {"away", Transform::translate(30, -20, 50)},
        {"tiny", Transform::scale(1e-6, 1e-6, 1e-6)},
        {"tiny_and_away", Transform::translate(3, 1, -2) * Transform::scale(1e-3, 1e-3, 1e-3)},
        {"large", Transform::translate(1e4, -2e4, 1e4) * Transform::scale(1e4, 1e4, 1e4)},
        {"stretched", Transform::rotate(35, 1, 2, 3) * Transform::scale(1, 0.1, 3)}};
    return all;
}

/// A cube's faces as triangles, normals outward, at a place.
TriangleMesh cube(const Transform& place) {
    TriangleMesh mesh;
    for (int i = 0; i < 8; ++i) {
        mesh.positions.push_back(place.point(Vec3(i & 1 ? 1.0f : -1.0f, i & 2 ? 1.0f : -1.0f, i & 4 ? 1.0f : -1.0f)));
    }
    mesh.indices = {0, 2, 1, 1, 2, 3, 4, 5, 6, 5, 7, 6, 0, 1, 4, 1, 5, 4,
                    2, 6, 3, 3, 6, 7, 0, 4, 2, 2, 4, 6, 1, 3, 5, 3, 7, 5};
    return mesh;
}

/// From points where random rays meet a convex body: what is reflected never meets it again, and what goes through
/// meets its far side and nothing behind that, from where what is reflected comes back.
void expect_two_hits(Shape shape, const Transform& place, const std::string& name) {
    auto description = test::two_materials();
    test::add(description, std::move(shape), 1);
    const Scene scene(std::move(description));
    Pcg32 random(1);
    int seen = 0, met_again = 0, missed = 0, met_behind = 0, lost = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 origin = place.point(to_sphere(random.uniform2()) * 4.0f);
        const Vec3 target = place.point(to_sphere(random.uniform2()) * 0.7f);
        const TracedRay ray = Ray{origin, normalize(target - origin)};
        const auto hit = scene.intersect(ray);
        if (!hit) {
            continue;
        }
        ++seen;
        Vec3 w = to_sphere(random.uniform2());
        w = dot(w, hit->normal) > 0 ? w : -w;
        met_again += scene.intersect(ray.leave(*hit, w)).has_value();
        const TracedRay inside = ray.leave(*hit, -w);
        const auto far_side = scene.intersect(inside);
        // Along an edge, the ray may leave where it enters.
        missed += !far_side && dot(w, hit->normal) > 0.05f;
        if (far_side && far_side->distance > 100 * far_side->clearance) {
            met_behind += scene.intersect(inside.leave(*far_side, -w)).has_value();
            lost += !scene.intersect(inside.leave(*far_side, normalize(w + far_side->normal * -0.5f)));
        }
    }
    EXPECT_GT(seen, 10000) << name;
    EXPECT_EQ(met_again, 0) << name;
    EXPECT_LE(missed, seen / 2000) << name;
    EXPECT_LE(met_behind, seen / 2000) << name;
    EXPECT_LE(lost, seen / 2000) << name;
}

TEST(TracedRay, MeetsASphereTwice) {
    for (const Body& body : bodies()) {
        expect_two_hits(Quadric(Sphere{}, body.place), body.place, body.name);
    }
}

TEST(TracedRay, MeetsACylinderTwice) {
    for (const Body& body : bodies()) {
        // So long that next to nothing leaves through its ends.
        expect_two_hits(CylinderShell(Cylinder{1, -300, 300}, body.place), body.place, body.name);
    }
}

TEST(TracedRay, MeetsAMeshTwice) {
    for (const Body& body : bodies()) {
        expect_two_hits(cube(body.place), body.place, body.name);
    }
}

TEST(TracedRay, ForgetsWhatItHasMetIfItStartsAnew) {
    auto description = test::two_materials();
    const Transform place = bodies()[1].place;
    test::add(description, Quadric(Sphere{}, place));
    const Scene scene(std::move(description));
    Pcg32 random(2);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 origin = place.point(to_sphere(random.uniform2()) * 4.0f);
        const auto hit = scene.intersect(Ray{origin, normalize(place.point(Vec3(0)) - origin)});
        ASSERT_TRUE(hit);
        const Vec3 w = Frame::from_z(hit->normal).to_world(to_cosine_hemisphere(random.uniform2()));
        hits += scene.intersect(Ray{hit->position, w}).has_value();
    }
    EXPECT_GT(hits, 20);
}

/// Two cubes side by side along x, `gap` apart, as interfaces, scaled and moved.
SceneDescription side_by_side(float gap, const Transform& place) {
    auto description = test::two_materials();
    test::add(description, cube(place * Transform::translate(-1 - 0.5 * gap, 0, 0)), 1);
    test::add(description, cube(place * Transform::translate(1 + 0.5 * gap, 0, 0)), 1);
    return description;
}

// Whatever lies between them, nothing or less than a float can tell.
TEST(TracedRay, PassesEachOfTheInterfacesThatTouch) {
    for (const Body& body : bodies()) {
        for (const float gap : {0.0f, 1e-7f, 1e-6f, 1e-5f, 1e-4f, 1e-3f}) {
            const Scene scene(side_by_side(gap, body.place));
            Pcg32 random(3);
            for (int i = 0; i < 2000; ++i) {
                const Vec3 from(-3, 0.9f * (2 * random.uniform() - 1), 0.9f * (2 * random.uniform() - 1));
                const Vec3 to(3, 0.9f * (2 * random.uniform() - 1), 0.9f * (2 * random.uniform() - 1));
                const Vec3 origin = body.place.point(from);
                TracedRay ray = Ray{origin, normalize(body.place.point(to) - origin)};
                std::vector<SurfaceElement> met;
                while (const auto hit = scene.intersect(ray)) {
                    ASSERT_GE(hit->distance, 0);
                    ASSERT_EQ(std::count(met.begin(), met.end(), hit->element), 0);
                    met.push_back(hit->element);
                    ray.pass(*hit);
                }
                ASSERT_EQ(met.size(), 4u) << body.name << ' ' << gap;
            }
        }
    }
}

// A box stands on a floor: what the floor scatters goes back through as much of the box as was passed on the way to it,
// though both are in one place.
TEST(TracedRay, GoesBackThroughWhatTouchesTheSurfaceItLeaves) {
    for (const Body& body : bodies()) {
        for (const float gap : {-1e-7f, 0.0f, 1e-7f, 1e-6f, 1e-3f}) {
            auto description = test::two_materials();
            test::add(description, cube(body.place * Transform::translate(0, 0, 1 + gap)), 1);
            TriangleMesh floor;
            for (const Vec3& p : {Vec3(-7, -5, 0), Vec3(9, -5, 0), Vec3(0, 13, 0)}) {
                floor.positions.push_back(body.place.point(p));
            }
            floor.indices = {0, 1, 2};
            test::add(description, std::move(floor));
            const Scene scene(std::move(description));
            Pcg32 random(4);
            int wrong = 0, passed = 0;
            constexpr int rays = 2000;
            for (int i = 0; i < rays; ++i) {
                const Vec3 from = body.place.point({0.1f, 0.2f, 1});
                const Vec3 to = body.place.point({random.uniform() - 0.5f, random.uniform() - 0.5f, 0});
                TracedRay ray = Ray{from, normalize(to - from)};
                auto hit = scene.intersect(ray);
                bool was_passed = false;
                while (hit && scene.is_interface(*hit)) {
                    was_passed = true;
                    ray.pass(*hit);
                    hit = scene.intersect(ray);
                }
                ASSERT_TRUE(hit) << body.name << ' ' << gap;
                const Vec3 up = dot(hit->normal, ray.direction) < 0 ? hit->normal : -hit->normal;
                const Vec3 w = Frame::from_z(up).to_world(to_cosine_hemisphere(random.uniform2()));
                const auto bottom = scene.intersect(ray.leave(*hit, w));
                // What lies below the floor by less than rounding need not be met.
                const bool is_met = bottom && bottom->element.surface == 0 && dot(bottom->normal, w) < 0;
                wrong += is_met != was_passed;
                passed += was_passed;
            }
            EXPECT_LE(wrong, rays / 50) << body.name << ' ' << gap;  // the flattest rays cannot tell
            EXPECT_TRUE(gap < 1e-4f || passed == rays) << body.name << ' ' << gap;
        }
    }
}

// A floor at height 0 is known the better the nearer the origin; how far the way there was is not.
TEST(TracedRay, GoesBackThroughWhatTouchesTheFloorNearTheOrigin) {
    for (const bool floor_first : {false, true}) {
        for (const float reach : {1.0f, 0.1f, 1e-2f, 1e-4f, 1e-6f, 0.0f}) {
            auto description = test::two_materials();
            TriangleMesh floor = test::square();
            for (Vec3& p : floor.positions) {
                p *= 4.0f;
            }
            const TriangleMesh box = cube(Transform::translate(0, 0, 10) * Transform::scale(1, 1, 10));
            for (const bool is_floor : {floor_first, !floor_first}) {
                test::add(description, is_floor ? floor : box, is_floor ? 0 : 1);
            }
            const Scene scene(std::move(description));
            Pcg32 random(6);
            int met_again = 0, passed = 0;
            constexpr int rays = 2000;
            for (int i = 0; i < rays; ++i) {
                const Vec3 from(0.1f, -0.3f, 8);
                const Vec3 to(reach * (random.uniform() - 0.5f), reach * (random.uniform() - 0.5f), 0);
                TracedRay ray = Ray{from, normalize(to - from)};
                auto hit = scene.intersect(ray);
                bool was_passed = false;
                while (hit && scene.is_interface(*hit)) {
                    was_passed = true;
                    ray.pass(*hit);
                    hit = scene.intersect(ray);
                }
                ASSERT_TRUE(hit);
                const Vec3 w = normalize(Vec3(random.uniform() - 0.5f, random.uniform() - 0.5f, 1));
                const auto bottom = scene.intersect(ray.leave(*hit, w));
                passed += was_passed;
                met_again += bottom && bottom->normal.z < 0;
                ASSERT_EQ(bottom && bottom->normal.z < 0, was_passed) << floor_first << ' ' << reach << ' ' << w;
            }
            EXPECT_EQ(met_again, passed);
            EXPECT_GT(floor_first ? passed : rays - passed, 0) << "of two in one place either may come first";
        }
    }
}

TEST(TracedRay, LeavesTheSeamOfAMeshWhereNothingIsRounded) {
    // On the diagonal of two triangles at the origin a position has no rounding, and so no clearance.
    SceneDescription s;
    test::add_parallelogram(s, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, test::add_diffuse(s, Rgb(0.5f)));
    const Scene scene(std::move(s));
    const TracedRay down(Ray{{0, 0, 2}, {0, 0, -1}});
    std::optional<Hit> hit = scene.intersect(down);
    ASSERT_TRUE(hit);
    hit->position = {0, 0, 0};
    hit->clearance = 0;
    Pcg32 random(1);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 up = to_cosine_hemisphere(random.uniform2());
        ASSERT_FALSE(scene.intersect(down.leave(*hit, up))) << up;
        ASSERT_FALSE(scene.intersect(down.leave(*hit, -up))) << up;
    }
}

// Nearly the same floor twice, as modellers leave it: neither is in the shadow of the other.
TEST(TracedRay, LeavesOpaqueSurfacesThatCoincide) {
    auto description = test::two_materials();
    for (const float height : {1.0f, 1.0f, 1 + 1e-7f}) {
        test::add(description, test::square(height));
    }
    const Scene scene(std::move(description));
    Pcg32 random(5);
    for (int i = 0; i < 5000; ++i) {
        const Vec3 from(0.3f, 0.2f, 3);
        const Vec3 to(random.uniform() - 0.5f, random.uniform() - 0.5f, 1);
        const TracedRay ray = Ray{from, normalize(to - from)};
        const auto hit = scene.intersect(ray);
        ASSERT_TRUE(hit);
        const Vec3 w = to_cosine_hemisphere(random.uniform2());
        EXPECT_FALSE(scene.intersect(ray.leave(*hit, w)));
        EXPECT_FALSE(scene.is_occluded(ray.leave(*hit, w), infinity));
    }
}

}  // namespace
}  // namespace wend
