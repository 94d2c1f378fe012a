#include <tests/sampling/verdicts.h>
#include <tests/scene/small_scene.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <vector>

namespace wend {
namespace {

Vec3 point_in_cube(Pcg32& random, float extent) {
    const auto one = [&] { return extent * (2 * random.uniform() - 1); };
    const float x = one(), y = one();
    return {x, y, one()};
}

/// A shape of unit size in its own space, with the distance and outward normal of its first hit by the plainest
/// mathematics.
struct Exact {
    Transform place;
    std::function<double(const Imath::V3d& o, const Imath::V3d& d)> distance;  ///< infinite where missed
    std::function<Vec3(const Vec3& p)> normal;
};

double first_positive(double a, double b) {
    return a > 0 ? a : (b > 0 ? b : infinity);
}

double unit_sphere(const Imath::V3d& o, const Imath::V3d& d) {
    const double a = d.dot(d), b = o.dot(d), c = o.dot(o) - 1, discriminant = b * b - a * c;
    return discriminant < 0 ? infinity
                            : first_positive((-b - std::sqrt(discriminant)) / a, (-b + std::sqrt(discriminant)) / a);
}

double unit_square(const Imath::V3d& o, const Imath::V3d& d) {
    const double t = -o.z / d.z;
    return t > 0 && std::abs(o.x + t * d.x) < 1 && std::abs(o.y + t * d.y) < 1 ? t : infinity;
}

double unit_disk(const Imath::V3d& o, const Imath::V3d& d) {
    const double t = -o.z / d.z;
    return t > 0 && std::hypot(o.x + t * d.x, o.y + t * d.y) < 1 ? t : infinity;
}

Transform place(double x, double y, double z, double degrees, double sx, double sy, double sz) {
    return Transform::translate(x, y, z) * Transform::rotate(degrees, 1, 0.5, -2) * Transform::scale(sx, sy, sz);
}

/// Spheres, squares and disks, stretched and mirrored, some of them instances.
struct Collection {
    SceneDescription description = test::two_materials();
    std::vector<Exact> exact;

    Collection() {
        const auto up = [](const Vec3&) { return Vec3(0, 0, 1); };
        const auto outward = [](const Vec3& p) { return p; };
        for (const Transform& at :
             {place(0, 0, 0, 20, 1, 1, 1), place(2, 1, -1, 70, 0.3, 1.5, 0.8), place(-2, -1, 0, 10, -1, 0.5, 0.7)}) {
            test::add(description, Quadric(Sphere{}, at));
            exact.push_back({at, unit_sphere, outward});
        }
        const Transform disk_at = place(0, 2, 2, 130, 2, 0.7, 1);
        test::add(description, Quadric(Disk{}, disk_at));
        exact.push_back({disk_at, unit_disk, up});
        const Transform square_at = place(-1, -2, 2, 200, 1, 2, 1);
        TriangleMesh mesh = test::square();
        for (Vec3& p : mesh.positions) {
            p = square_at.point(p);
        }
        test::add(description, mesh);
        exact.push_back({square_at, unit_square, up});

        const Transform within = place(0, 0, 0.3, 0, 0.5, 0.7, 0.5);
        description.objects.push_back(
            {{static_cast<int>(description.surfaces.size()), static_cast<int>(description.surfaces.size()) + 1}});
        description.surfaces.push_back({Quadric(Sphere{}, within), 0});
        description.surfaces.push_back({test::square(), 0});
        for (const Transform& at : {place(3, -2, 1, 45, 1, 0.6, 1.4), place(-3, 2, -2, 300, 0.8, -1.1, 0.5)}) {
            description.instances.push_back({0, at});
            exact.push_back({at * within, unit_sphere, outward});
            exact.push_back({at, unit_square, up});
        }
    }
};

TEST(SceneIntersect, AgreesWithPlainMathematics) {
    Collection collection;
    const std::vector<Exact> exact = collection.exact;
    const Scene scene(std::move(collection.description));
    Pcg32 random(1);
    int hits = 0, disagreements = 0;
    for (int i = 0; i < 20000; ++i) {
        const Vec3 origin = point_in_cube(random, 5);
        const Ray ray{origin, normalize(point_in_cube(random, 3) - origin)};
        double nearest = infinity;
        const Exact* first = nullptr;
        for (const Exact& e : exact) {
            const Transform inverse = e.place.inverse();
            const double t =
                e.distance(Imath::V3d(inverse.point(ray.origin)), Imath::V3d(inverse.vector(ray.direction)));
            if (t < nearest) {
                nearest = t;
                first = &e;
            }
        }
        const auto hit = scene.intersect(ray);
        if (hit.has_value() != (first != nullptr) || (hit && std::abs(hit->distance - nearest) > 1e-3)) {
            ++disagreements;  // at an edge or a silhouette either answer is right
            continue;
        }
        EXPECT_EQ(scene.is_occluded(ray, infinity), hit.has_value());
        if (hit) {
            ++hits;
            EXPECT_LT(length(hit->position - ray.at(hit->distance)), 1e-4f);
            const Vec3 normal =
                normalize(first->place.normal(first->normal(first->place.inverse().point(hit->position))));
            // A mesh that is mirrored as a whole keeps the side of its normals; one made in the world has its own.
            EXPECT_GT(dot(hit->normal, normal), 0.999f) << "ray " << i;
            EXPECT_NEAR(length(hit->normal), 1, 1e-5f);
            EXPECT_GT(dot(hit->shading.n, hit->normal), 0.999f);
            EXPECT_NEAR(dot(hit->shading.s, hit->shading.n), 0, 1e-5f);
            EXPECT_FALSE(scene.intersect(ray, 0.999f * hit->distance));
            EXPECT_FALSE(scene.is_occluded(ray, 0.999f * hit->distance));
        }
    }
    EXPECT_GT(hits, 5000);
    EXPECT_LT(disagreements, 20);
}

TEST(SceneIntersect, CutSpheresAreOpen) {
    auto description = test::two_materials();
    test::add(description, Quadric(Sphere{1, -1, 0}, Transform()));
    const Scene scene(std::move(description));
    // From above into the bowl: its inner side, with the normal still outward.
    const auto hit = scene.intersect(Ray{{0, 0, 3}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 4, 1e-5f);
    EXPECT_NEAR(hit->normal.z, -1, 1e-5f);
    EXPECT_FALSE(scene.intersect(Ray{{-3, 0, 0.5f}, {1, 0, 0}}));
}

TEST(SceneIntersect, FlippedNormalsPointTheOtherWay) {
    auto description = test::two_materials();
    test::add(description, Quadric(Sphere{}, Transform())).flip_normal = true;
    test::add(description, test::square(5)).flip_normal = true;
    const Scene scene(std::move(description));
    EXPECT_NEAR(scene.intersect(Ray{{0, 0, -3}, {0, 0, 1}})->normal.z, 1, 1e-5f);
    EXPECT_NEAR(scene.intersect(Ray{{0.2f, 0.1f, 3}, {0, 0, 1}})->normal.z, -1, 1e-5f);
}

TEST(SceneIntersect, MeshesInterpolateNormalsAndTextureCoordinates) {
    auto description = test::two_materials();
    TriangleMesh mesh = test::square();
    mesh.uvs = {{0, 0}, {2, 0}, {2, 3}, {0, 3}};
    mesh.normals = {normalize(Vec3(-0.2f, 0, 1)), normalize(Vec3(0.2f, 0, 1)), normalize(Vec3(0.2f, 0, 1)),
                    normalize(Vec3(-0.2f, 0, 1))};
    test::add(description, mesh);
    const Scene scene(std::move(description));
    const auto hit = scene.intersect(Ray{{0.5f, -0.25f, 2}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->uv.x, 1.5f, 1e-5f);
    EXPECT_NEAR(hit->uv.y, 3 * 0.375f, 1e-5f);
    EXPECT_EQ(hit->normal, Vec3(0, 0, 1));
    EXPECT_GT(hit->shading.n.x, 0.05f);
    EXPECT_GT(hit->shading.s.x, 0.9f);
    EXPECT_EQ(hit->element.primitive, 0u);
}

TEST(SceneNormals, ChangeAlongSurfacesAsTheyAreBent) {
    const Transform squeezed = Transform::translate(0.1f, -0.2f, 0.3f) * Transform::scale(1, 0.6f, 1.4f);
    TriangleMesh mesh = test::square();
    mesh.normals = {Vec3(-0.4f, 0.1f, 2), Vec3(0.3f, 0, 1), Vec3(0.2f, 0.5f, 1), Vec3(-0.2f, 0, 1)};
    const auto sphere = Quadric(Sphere{}, squeezed);
    struct Case {
        const char* name;
        Shape shape;
        bool flip = false, instance = false;
    };
    const Case cases[] = {{"sphere", sphere},
                          {"sphere inside out", sphere, true},
                          {"sphere in an instance", sphere, false, true},
                          {"mesh", mesh},
                          {"mesh in an instance", mesh, false, true},
                          {"flat mesh", test::square()},
                          {"disk", Quadric(Disk{}, squeezed)}};
    for (const Case& c : cases) {
        SCOPED_TRACE(c.name);
        auto description = test::two_materials();
        test::add(description, c.shape).flip_normal = c.flip;
        if (c.instance) {
            description.objects.push_back({{description.world_surfaces.back()}});
            description.world_surfaces.clear();
            description.instances.push_back({0, Transform::rotate(20, 1, 2, 0) * Transform::scale(2, 1, 1)});
        }
        const Scene scene(std::move(description));
        Pcg32 random(1);
        int seen = 0;
        for (int i = 0; i < 1000; ++i) {
            const Vec3 origin = point_in_cube(random, 1) + Vec3(0, 0, 4);
            const Vec3 step = point_in_cube(random, 1e-3f);
            const auto hit = scene.intersect(Ray{origin, {0, 0, -1}});
            const auto beside = scene.intersect(Ray{origin + Vec3(step.x, step.y, 0), {0, 0, -1}});
            // At a silhouette and across an edge normals do not change smoothly.
            if (!hit || !beside || hit->element != beside->element || std::abs(hit->normal.z) < 0.3f) {
                continue;
            }
            ++seen;
            const Vec3 change = scene.normal_change(*hit, beside->position - hit->position);
            EXPECT_LT(length(hit->shading.n + change - beside->shading.n), 2e-5f);
        }
        EXPECT_GT(seen, 200);
    }
}

/// Media 0 inside, 1 outside of a unit sphere.
Scene sphere_between_media(int material, bool flip) {
    auto description = test::two_materials();
    description.media.assign(2, HomogeneousMedium{Rgb(1), Rgb(1), Rgb(0), PhaseFunction()});
    Surface& sphere = test::add(description, Quadric(Sphere{}, Transform()), material);
    sphere.interior = 0;
    sphere.exterior = 1;
    sphere.flip_normal = flip;
    return Scene(std::move(description));
}

TEST(SceneMedia, NormalsPointToTheExterior) {
    for (const bool flip : {false, true}) {
        const Scene scene = sphere_between_media(1, flip);
        const auto hit = scene.intersect(Ray{{0, 0, -3}, {0, 0, 1}});
        ASSERT_TRUE(hit);
        EXPECT_EQ(scene.medium_beyond(*hit, {0, 0, 1}, {}).id, flip ? 1 : 0);
        EXPECT_EQ(scene.medium_beyond(*hit, {0, 0, -1}, {}).id, flip ? 0 : 1);
    }
    auto description = test::two_materials();
    test::add(description, test::square());
    const Scene scene(std::move(description));
    EXPECT_EQ(scene.medium_beyond(*scene.intersect(Ray{{0.1f, 0, -3}, {0, 0, 1}}), {0, 0, 1}, MediumState(7)).id, 7);
}

TEST(SceneVisibility, InterfacesDoNotOcclude) {
    const Scene scene = sphere_between_media(1, false);
    const Ray ray{{0, 0, -3}, {0, 0, 1}};
    EXPECT_TRUE(scene.has_interfaces());
    EXPECT_FALSE(scene.is_occluded(ray, infinity));
    const auto hit = scene.intersect_interface(ray, infinity);
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 2, 1e-5f);
    EXPECT_TRUE(scene.is_interface(*hit));
    EXPECT_TRUE(scene.is_there(*hit, ray));
    EXPECT_FALSE(scene.intersect_interface(ray, 1.9f));
}

TEST(SceneVisibility, OpaqueSurfacesAreNoInterfaces) {
    const Scene scene = sphere_between_media(0, false);
    const Ray ray{{0, 0, -3}, {0, 0, 1}};
    EXPECT_FALSE(scene.has_interfaces());
    EXPECT_TRUE(scene.is_occluded(ray, infinity));
    EXPECT_FALSE(scene.is_occluded(ray, 1.9f));
    EXPECT_FALSE(scene.intersect_interface(ray, infinity));
}

TEST(SceneVisibility, PartlyTransparentSurfacesPassTheirShare) {
    auto description = test::two_materials();
    const TextureId alpha = description.textures.add_constant(Rgb(0.3f));
    test::add(description, test::square(0)).alpha = alpha;
    const Scene scene(std::move(description));
    Pcg32 random(2);
    Moments met, blocked;
    for (int i = 0; i < 1500000; ++i) {
        const Vec3 target(1.8f * random.uniform() - 0.9f, 1.8f * random.uniform() - 0.9f, 0);
        const Vec3 origin(random.uniform(), random.uniform(), 2);
        const Ray ray{origin, normalize(target - origin)};
        const auto hit = scene.intersect(ray);
        met.add(hit.has_value());
        const auto passable = scene.intersect_interface(ray, infinity);
        ASSERT_TRUE(passable);
        blocked.add(scene.is_there(*passable, ray));
        EXPECT_FALSE(scene.is_occluded(ray, infinity));
    }
    EXPECT_TRUE(test::is_within_one_percent(met, 0.3));
    EXPECT_TRUE(test::is_within_one_percent(blocked, 0.3));
}

TEST(SceneVisibility, BehindATransparentSurfaceIsTheNext) {
    auto description = test::two_materials();
    const TextureId none = description.textures.add_constant(Rgb(0));
    test::add(description, test::square(0)).alpha = none;
    test::add(description, test::square(-1));
    const Scene scene(std::move(description));
    const auto hit = scene.intersect(Ray{{0.1f, 0.2f, 2}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_NEAR(hit->distance, 3, 1e-3f);
    EXPECT_FALSE(scene.intersect(Ray{{0.1f, 0.2f, 2}, {0, 0, -1}}, 2.5f));
}

TEST(SceneLights, PrimitivesKnowTheirLight) {
    auto description = test::two_materials();
    test::add(description, test::square()).first_light = 4;
    const Scene scene(std::move(description));
    EXPECT_EQ(scene.intersect(Ray{{0.5f, -0.5f, 1}, {0, 0, -1}})->light, 4);
    EXPECT_EQ(scene.intersect(Ray{{-0.5f, 0.5f, 1}, {0, 0, -1}})->light, 5);
}

TEST(SceneLights, ARayDoesNotMeetTheFlatLampThatItIsAimedAt) {
    auto description = test::two_materials();
    test::add(description, test::square()).first_light = 0;
    const Scene scene(std::move(description));
    const auto is_occluded = [&](int aimed_at) {
        TracedRay ray = Ray{{0.5f, -0.5f, 1}, {0, 0, -1}};
        ray.aim_at({0.5f, -0.5f, 0});
        return scene.is_occluded(ray, 2, scene.flat_element(aimed_at));
    };
    EXPECT_FALSE(is_occluded(0));
    EXPECT_TRUE(is_occluded(1)) << "that is the other triangle";
}

TEST(Scene, WithoutSurfacesNothingIsHit) {
    const Scene scene(test::two_materials());
    EXPECT_FALSE(scene.intersect(Ray{{0, 0, 0}, {0, 0, 1}}));
    EXPECT_FALSE(scene.is_occluded(Ray{{0, 0, 0}, {0, 0, 1}}, infinity));
    EXPECT_FALSE(scene.bounds().isEmpty());
}

}  // namespace
}  // namespace wend
