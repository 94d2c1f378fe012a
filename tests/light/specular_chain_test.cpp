// Ways to lights through boundaries that refract: their rays, and their densities against directions counted one by
// one.
#include <tests/support/scenes.h>

#include <wend/core/vector.h>
#include <wend/light/specular_chain.h>
#include <wend/medium/fresnel.h>
#include <wend/sampling/warp.h>

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace wend {
namespace {

constexpr float ior = 1.5f;
constexpr float tint = 0.5f;  // of green light, at each boundary
const Vec3 corner(0.9f, 4, -0.5f);
constexpr float lamp_size = 0.4f;
const Vec3 eye(0, 0, 0);

struct Boundaries {
    const char* name;
    std::function<void(SceneDescription&)> add;
    int refractions;
};

void PrintTo(const Boundaries& boundaries, std::ostream* out) {
    *out << boundaries.name;
}

/// A ball of triangles whose normals are those of the ball, squeezed.
TriangleMesh ball(float radius) {
    constexpr int rings = 24, spokes = 48;
    TriangleMesh mesh;
    for (int i = 0; i <= rings; ++i) {
        for (int k = 0; k < spokes; ++k) {
            const auto theta = static_cast<float>(pi * i / rings), phi = static_cast<float>(2 * pi * k / spokes);
            const Vec3 n(std::sin(theta) * std::cos(phi), std::cos(theta), std::sin(theta) * std::sin(phi));
            mesh.positions.push_back(Vec3(n.x, 0.7f * n.y, n.z) * radius);
            mesh.normals.push_back(Vec3(n.x, n.y / 0.7f, n.z) * 3.0f);
        }
    }
    for (std::uint32_t i = 0; i < rings; ++i) {
        for (std::uint32_t k = 0; k < spokes; ++k) {
            const std::uint32_t a = i * spokes + k, b = i * spokes + (k + 1) % spokes;
            mesh.indices.insert(mesh.indices.end(), {a, b, a + spokes, b, b + spokes, a + spokes});
        }
    }
    return mesh;
}

Surface& add(SceneDescription& s, Shape shape, int material) {
    s.world_surfaces.push_back(static_cast<int>(s.surfaces.size()));
    s.surfaces.push_back({std::move(shape), material});
    return s.surfaces.back();
}

void add_instance(SceneDescription& s, const Transform& place, Shape shape, int material) {
    s.surfaces.push_back({std::move(shape), material});
    s.objects.push_back({{static_cast<int>(s.surfaces.size()) - 1}});
    s.instances.push_back({static_cast<int>(s.objects.size()) - 1, place});
}

Quadric squeezed_sphere(float radius) {
    return Quadric(Sphere{radius, -radius, radius},
                   Transform::translate(0.1f, 0.2f, -0.1f) * Transform::scale(1, 0.8f, 1.1f));
}

const Boundaries boundaries[] = {
    {"Pane",
     [](SceneDescription& s) {
         test::add_box(s, Box3(Vec3(-9, 1, -9), Vec3(9, 1.8f, 9)), test::add_dielectric(s, ior));
     },
     2},
    {"Liquid",
     [](SceneDescription& s) { test::add_box(s, Box3(Vec3(-9, -9, -9), Vec3(9, 1, 9)), test::add_dielectric(s, ior)); },
     1},
    {"InsideAnEllipsoid", [](SceneDescription& s) { add(s, squeezed_sphere(1.5f), test::add_dielectric(s, 1.33f)); },
     1},
    {"InsideAnEllipsoidInsideOut",
     [](SceneDescription& s) { add(s, squeezed_sphere(1.5f), test::add_dielectric(s, 1 / 1.33f)).flip_normal = true; },
     1},
    {"InsideAMesh", [](SceneDescription& s) { add(s, ball(1.4f), test::add_dielectric(s, 1.2f)); }, 1},
    {"InsideAnInstance",
     [](SceneDescription& s) {
         add_instance(s, Transform::translate(0.2f, 0, 0.1f) * Transform::scale(2, 1.2f, 1.5f), ball(0.8f),
                      test::add_dielectric(s, 1.2f));
     },
     1},
    {"BehindAnInstancedBall",
     [](SceneDescription& s) {
         const Transform place = Transform::translate(0.1f, 1.7f, 0.1f) * Transform::scale(2, 0.6f, 2);
         add_instance(s, place, Quadric(Sphere{0.8f, -0.8f, 0.8f}, Transform()), test::add_dielectric(s, 1.15f));
     },
     2},
    {"Nested",
     [](SceneDescription& s) {
         test::add_sphere(s, {0.05f, 0, 0}, 0.9f, test::add_dielectric(s, 1.1f));
         test::add_sphere(s, {0.05f, 0.1f, 0}, 1.5f, test::add_interface(s));
         test::add_sphere(s, {0, 0, 0.1f}, 2, test::add_dielectric(s, 1.2f));
     },
     2},
};

Scene under_lamp(const std::function<void(SceneDescription&)>& add_boundaries) {
    SceneDescription s = test::scene_with_camera({0, 0, 0}, {0, 1, 1}, 40, 8);
    test::add_lamp(s, corner, lamp_size, Rgb(1.0f), test::add_diffuse(s, Rgb(0.0f)));
    add_boundaries(s);
    for (Material& material : s.materials) {
        if (auto* glass = std::get_if<DielectricMaterial>(&material)) {
            glass->transmittance = s.textures.add_constant(Rgb(1, tint, 1));
        }
    }
    return Scene(std::move(s));
}

std::optional<SpecularChain> way_to(const Scene& scene, const Vec3& point, MediumId medium = vacuum) {
    return find_specular_chain(scene, {eye, normalize(point - eye)}, length(point - eye), MediumState(medium));
}

Vec3 point_on_lamp(const Vec2& u) {
    const Vec2 b = to_triangle(u);
    return corner + Vec3(b.x, 0, b.y) * lamp_size;
}

/// Where a ray goes that every boundary refracts.
struct Followed {
    Vec3 direction;
    bool meets_lamp = false;
    bool leaves = false;
};

Followed follow(const Scene& scene, TracedRay ray) {
    for (int i = 0; i < 10; ++i) {
        const auto hit = scene.intersect(ray);
        if (!hit || hit->light >= 0) {
            return {ray.direction, hit.has_value(), !hit.has_value()};
        }
        if (scene.is_interface(*hit)) {
            ray.pass(*hit);
            continue;
        }
        const Vec3& w = ray.direction;
        const auto refracted = refract(-w, hit->shading.n, std::get<DielectricMaterial>(scene.material(*hit)).ior);
        if (!refracted) {
            return {w};
        }
        ray = ray.leave(*hit, refracted->direction);
    }
    return {ray.direction};
}

/// The solid angle around `middle` of the directions that `counts` is true of: a square as wide as given is searched.
double solid_angle(const Vec3& middle, double width, const std::function<bool(const Vec3&)>& counts) {
    constexpr int directions = 500;
    const Frame frame = Frame::from_z(middle);
    double sum = 0;
    for (int i = 0; i < directions; ++i) {
        for (int k = 0; k < directions; ++k) {
            const double x = width * ((i + 0.5) / directions - 0.5), y = width * ((k + 0.5) / directions - 0.5);
            const Vec3 w = normalize(frame.n + frame.s * static_cast<float>(x) + frame.t * static_cast<float>(y));
            sum += counts(w) ? std::pow(1 + x * x + y * y, -1.5) : 0;
        }
    }
    return sum * sqr(width / directions);
}

class SpecularChains : public testing::TestWithParam<Boundaries> {};

TEST_P(SpecularChains, GoToThePoint) {
    const Scene scene = under_lamp(GetParam().add);
    for (const Vec2& u : {Vec2(0.3f, 0.5f), Vec2(0.9f, 0.1f), Vec2(0.05f, 0.6f)}) {
        const Vec3 point = point_on_lamp(u);
        const auto way = way_to(scene, point);
        ASSERT_TRUE(way);
        EXPECT_EQ(way->refractions, GetParam().refractions);
        EXPECT_EQ(way->end.light, 0);
        EXPECT_LT(length(way->end.position - point), 2e-4f);
        Vec3 at = eye;
        Vec3 before = way->direction;
        float transmitted = 1;
        for (const SpecularChain::Leg& leg : way->legs()) {
            EXPECT_LT(length(leg.ray.origin - at), 1e-4f);
            // Clear of what it starts on.
            const float start = &leg == &way->legs().front() ? 0.0f : 1e-4f;
            const auto hit = scene.intersect({leg.ray.at(start), leg.ray.direction});
            ASSERT_TRUE(hit);
            EXPECT_NEAR(hit->distance + start, leg.length, 1e-4f);
            if (&leg != &way->legs().front() && length(leg.ray.direction - before) > 1e-6f) {
                // Of the last boundary: the tangential part of the direction grows by the ratio of the indices.
                const auto last = scene.intersect({at - before * 0.01f, before});
                ASSERT_TRUE(last);
                const Vec3 n = last->shading.n;
                const float index = std::get<DielectricMaterial>(scene.material(*last)).ior;
                const float ratio = dot(before, n) < 0 ? index : 1 / index;
                EXPECT_LT(
                    length((before - n * dot(before, n)) - (leg.ray.direction - n * dot(leg.ray.direction, n)) * ratio),
                    1e-4f);
                transmitted *= (1 - fresnel_dielectric(-dot(before, n), index)) / sqr(ratio);
            }
            before = leg.ray.direction;
            at = leg.ray.at(leg.length);
        }
        EXPECT_LT(length(at - point), 2e-4f);
        EXPECT_NEAR(way->transmitted.r, transmitted, 1e-4f * transmitted);
        EXPECT_FLOAT_EQ(way->transmitted.g, way->transmitted.r * std::pow(tint, static_cast<float>(way->refractions)));
    }
}

TEST_P(SpecularChains, HaveTheDensitiesOfTheirDirections) {
    const Scene scene = under_lamp(GetParam().add);
    const auto middle = way_to(scene, point_on_lamp({0.5f, 0.5f}));
    ASSERT_TRUE(middle);
    // The solid angle in which the lamp is seen, by points on the lamp ...
    constexpr int points = 40;
    const float area = 0.5f * sqr(lamp_size);
    double by_points = 0;
    int found = 0;
    for (int i = 0; i < points; ++i) {
        for (int k = 0; k < points; ++k) {
            const Vec3 point = point_on_lamp({(i + 0.5f) / points, (k + 0.5f) / points});
            if (const auto way = way_to(scene, point)) {
                ++found;
                by_points += std::abs(normalize(point - eye).y) / (length_squared(point - eye) * way->density_ratio);
            }
        }
    }
    EXPECT_EQ(found, points * points);
    by_points *= area / (points * points);
    // ... and by directions.
    const double by_directions = solid_angle(middle->direction, 6 * std::sqrt(by_points), [&](const Vec3& w) {
        return follow(scene, {eye, w}).meets_lamp;
    });
    EXPECT_NEAR(by_points, by_directions, 0.005 * by_directions);
}

TEST_P(SpecularChains, HaveTheDensitiesOfTheirDirectionsToLightsAtInfinity) {
    const Scene scene = under_lamp(GetParam().add);
    const Vec3 target = normalize(Vec3(-0.2f, 1, 0.25f));
    const auto way_into = [&](const Vec3& w) { return find_specular_chain(scene, {eye, w}, infinity, {}); };
    const auto middle = way_into(target);
    ASSERT_TRUE(middle);
    EXPECT_EQ(middle->refractions, GetParam().refractions);
    EXPECT_LT(length(middle->legs().back().ray.direction - target), 2e-5f);
    // The solid angle that a disk in the sky is seen in.
    constexpr int points = 40;
    constexpr float cosine = 0.995f;
    const Frame frame = Frame::from_z(target);
    double by_points = 0;
    for (int i = 0; i < points; ++i) {
        for (int k = 0; k < points; ++k) {
            const auto way = way_into(frame.to_world(to_cone({(i + 0.5f) / points, (k + 0.5f) / points}, 1 - cosine)));
            ASSERT_TRUE(way);
            by_points += 1 / way->density_ratio;
        }
    }
    by_points *= 2 * pi * (1 - cosine) / (points * points);
    // No wider than needed: the rim of a ball shows the sky once more.
    const double by_directions = solid_angle(middle->direction, 2.2 * std::sqrt(by_points), [&](const Vec3& w) {
        const Followed ray = follow(scene, {eye, w});
        return ray.leaves && dot(ray.direction, target) > cosine;
    });
    EXPECT_NEAR(by_points, by_directions, 0.005 * by_directions);
}

INSTANTIATE_TEST_SUITE_P(Boundaries, SpecularChains, testing::ValuesIn(boundaries),
                         [](const auto& b) { return std::string(b.param.name); });

TEST(SpecularChain, KnowsTheMediaOfItsLegs) {
    MediumId liquid = vacuum, fog = vacuum;
    const Scene scene = under_lamp([&](SceneDescription& s) {
        liquid = test::add_homogeneous(s, Rgb(0.3f), Rgb(0.0f));
        fog = test::add_homogeneous(s, Rgb(0.1f), Rgb(0.0f));
        test::add_box(s, Box3(Vec3(-9, -9, -9), Vec3(9, 1, 9)), test::add_dielectric(s, ior), liquid, fog);
        test::add_box(s, Box3(Vec3(-9, 2, -9), Vec3(9, 8, 9)), test::add_interface(s), vacuum, fog);
    });
    const auto way = way_to(scene, point_on_lamp({0.5f, 0.5f}), liquid);
    ASSERT_TRUE(way);
    ASSERT_EQ(way->legs().size(), 3u);
    EXPECT_EQ(way->legs()[0].medium, liquid);
    EXPECT_EQ(way->legs()[1].medium, fog);
    EXPECT_EQ(way->legs()[2].medium, vacuum);
    EXPECT_EQ(way->legs()[0].refractions, 0);
    EXPECT_EQ(way->legs()[1].refractions, 1);
    EXPECT_EQ(way->legs()[2].refractions, 1);
    EXPECT_EQ(way->refractions, 1);
}

TEST(SpecularChain, LeavesALiquidWhereTheStraightOneIsTotallyReflected) {
    const Vec3 outward = normalize(Vec3(-0.6f, 0.8f, 0));
    const Scene scene = under_lamp([&](SceneDescription& s) {
        const Vec3 across(0.8f, 0.6f, 0), along(0, 0, -1);
        test::add_parallelogram(s, outward * 1.5f - (across + along) * 9.0f, across * 18.0f, along * 18.0f,
                                test::add_dielectric(s, ior));
    });
    const Vec3 point = point_on_lamp({0.5f, 0.5f});
    ASSERT_FALSE(refract(-normalize(point - eye), outward, ior));
    const auto way = way_to(scene, point);
    ASSERT_TRUE(way);
    EXPECT_LT(length(way->end.position - point), 2e-4f);
}

TEST(SpecularChain, IsNothingWhereTheWayIsClearOrBlockedOrRough) {
    const Vec3 point = point_on_lamp({0.5f, 0.5f});
    const auto box = [](float low, float high, auto material) {
        return [=](SceneDescription& s) { test::add_box(s, Box3(Vec3(-9, low, -9), Vec3(9, high, 9)), material(s)); };
    };
    const auto glass = [](SceneDescription& s) { return test::add_dielectric(s, ior); };
    const auto rough = [](SceneDescription& s) { return test::add_dielectric(s, ior, 0.3f); };
    const auto wall = [](SceneDescription& s) { return test::add_diffuse(s, Rgb(0.5f)); };
    EXPECT_TRUE(way_to(under_lamp(box(1, 1.2f, glass)), point));
    EXPECT_FALSE(way_to(under_lamp([](SceneDescription&) {}), point));
    EXPECT_FALSE(way_to(under_lamp(box(1, 1.2f, rough)), point));
    EXPECT_FALSE(way_to(under_lamp(box(1, 1.2f, wall)), point));
    EXPECT_FALSE(way_to(under_lamp([&](SceneDescription& s) {
                            box(1, 1.2f, glass)(s);
                            box(2, 2.2f, wall)(s);
                        }),
                        point));
}

}  // namespace
}  // namespace wend
