#include <tests/scene/small_scene.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

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
        {"tiny", Transform::scale(1e-3, 1e-3, 1e-3)},
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

/// From points where random rays meet a convex body: rays outward never meet it again; rays inward do, on the far side.
void expect_never_rehits(Shape shape, const Transform& place, const std::string& name) {
    auto description = test::two_materials();
    test::add(description, std::move(shape));
    const Scene scene(std::move(description));
    const float size = length(scene.bounds().size());
    Pcg32 random(1);
    int spawned = 0, outward_hits = 0, inward_misses = 0, short_chords = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 origin = place.point(to_sphere(random.uniform2()) * 4.0f);
        const Vec3 target = place.point(to_sphere(random.uniform2()) * 0.7f);
        const auto hit = scene.intersect({origin, normalize(target - origin)});
        if (!hit) {
            continue;
        }
        Vec3 w = to_sphere(random.uniform2());
        const float cosine = dot(w, hit->normal);
        const auto again = scene.intersect(spawn_ray(hit->position, hit->normal, w));
        ++spawned;
        if (cosine > 0) {
            outward_hits += again.has_value();
        } else if (cosine < -0.05f) {
            // Inside, near an edge, the far side may be near indeed: but it is another surface or a chord.
            inward_misses += !again;
            short_chords += again && again->distance < 1e-5f * size;
        }
    }
    EXPECT_GT(spawned, 10000) << name;
    EXPECT_EQ(outward_hits, 0) << name;
    EXPECT_LE(inward_misses, spawned / 1000) << name;
    EXPECT_LE(short_chords, spawned / 1000) << name;
}

TEST(SpawnRay, NeverMeetsItsSphereAgain) {
    for (const Body& body : bodies()) {
        expect_never_rehits(Quadric(Sphere{}, body.place), body.place, body.name);
    }
}

TEST(SpawnRay, NeverMeetsItsTriangleAgain) {
    for (const Body& body : bodies()) {
        expect_never_rehits(cube(body.place), body.place, body.name);
    }
}

TEST(SpawnRay, WithoutTheOffsetItWould) {
    auto description = test::two_materials();
    const Transform place = bodies()[1].place;
    test::add(description, Quadric(Sphere{}, place));
    const Scene scene(std::move(description));
    Pcg32 random(2);
    int hits = 0;
    for (int i = 0; i < 2000; ++i) {
        const Vec3 origin = place.point(to_sphere(random.uniform2()) * 4.0f);
        const auto hit = scene.intersect({origin, normalize(place.point(Vec3(0)) - origin)});
        ASSERT_TRUE(hit);
        const Vec3 w = Frame::from_z(hit->normal).to_world(to_cosine_hemisphere(random.uniform2()));
        hits += scene.intersect({hit->position, w}).has_value();
    }
    EXPECT_GT(hits, 20);
}

TEST(SpawnRay, MovesToTheSideOfTheDirectionAndNotFar) {
    for (const Vec3& p : {Vec3(0, 0, 0), Vec3(1, 2, 3), Vec3(-500, 1e4f, 0.01f)}) {
        const Vec3 n = normalize(Vec3(1, -2, 0.5f));
        EXPECT_GT(dot(spawn_ray(p, n, n).origin - p, n), 0);
        EXPECT_LT(dot(spawn_ray(p, n, -n).origin - p, n), 0);
        EXPECT_LT(length(spawn_ray(p, n, n).origin - p), 1e-4f * (1 + length(p)));
    }
}

}  // namespace
}  // namespace wend
