// Connections to media that glow, against quadrature.
#include <tests/support/scenes.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

namespace wend {
namespace {

using test::Measured;

constexpr float flame_absorption = 1.5f;
constexpr float flame_radiance = 2.0f;
const Box3 flame(Vec3(0.6f, -0.3f, 0.5f), Vec3(1.1f, 0.4f, 1.6f));

MediumId add_glowing_grid(SceneDescription& s, const Box3& box) {
    constexpr int n = 12;
    auto grid = std::make_shared<Grid>(
        Vec3i(0), Vec3i(n), [](const Vec3i&, const Vec3i&) { return true; }, [](int, int, int) { return 1.0f; });
    const Vec3 size = box.size();
    // Well inside the voxels, where the density is 1 everywhere.
    const Transform index_from_world = Transform::translate(1, 1, 1) *
                                       Transform::scale((n - 3) / size.x, (n - 3) / size.y, (n - 3) / size.z) *
                                       Transform::translate(-box.min.x, -box.min.y, -box.min.z);
    auto emission = std::make_shared<GridEmission>();
    emission->radiance = Rgb(flame_radiance);
    s.media.push_back(GridMedium(grid, index_from_world, Box3(Vec3(1), Vec3(n - 2)), Rgb(flame_absorption), Rgb(0.0f),
                                 PhaseFunction(), emission));
    return static_cast<MediumId>(s.media.size()) - 1;
}

/// Length of a ray's part in a shape, and the distance to it.
struct Chord {
    float length = 0;
    float before = 0;
};
using Shape = std::function<Chord(const Ray&)>;

Chord through_flame(const Ray& ray) {
    float t0 = 0, t1 = 100;
    return clip_to_box(flame, ray.origin, ray.direction, t0, t1) ? Chord{t1 - t0, t0} : Chord{};
}

float glowing(float length) {
    return flame_radiance * -std::expm1(-flame_absorption * length);
}

/// ∫ L(ω) f(ω) dω over all directions from a point of what a shape sends there; f is to be smooth.
double arriving(const Vec3& p, const Shape& shape, const std::function<double(const Vec3&, const Chord&)>& f) {
    constexpr int n = 600;
    double sum = 0;
    for (int i = 0; i < n; ++i) {
        const float z = 2 * (static_cast<float>(i) + 0.5f) / n - 1;
        for (int j = 0; j < 2 * n; ++j) {
            const float phi = pi * (static_cast<float>(j) + 0.5f) / n;
            const float r = std::sqrt(1 - z * z);
            const Vec3 w(r * std::cos(phi), r * std::sin(phi), z);
            const Chord chord = shape({p, w});
            if (chord.length > 0) {
                sum += static_cast<double>(glowing(chord.length)) * f(w, chord);
            }
        }
    }
    return sum * 4 * static_cast<double>(pi) / (2.0 * n * n);
}

/// |mean - expected| within four standard errors, and the standard error small enough that a bias of 1 % would be seen.
void expect_agrees(const Measured& m, double expected) {
    EXPECT_TRUE(agrees(m.mean, m.standard_error, expected, 4, 1e-4))
        << m.mean << " +- " << m.standard_error << " expected " << expected;
    EXPECT_LT(4 * m.standard_error, 0.01 * expected) << "too few walks to see a bias of 1 %";
}

/// What leaves a floor of albedo 0.6 upwards.
double reflected(const Vec3& p, const Shape& shape) {
    return 0.6 / static_cast<double>(pi) *
           arriving(p, shape, [](const Vec3& w, const Chord&) { return std::max(0.0, static_cast<double>(w.z)); });
}

void add_floor(SceneDescription& s, MediumId medium = vacuum) {
    test::add_parallelogram(s, {-9, -9, 0}, {18, 0, 0}, {0, 18, 0}, test::add_diffuse(s, Rgb(0.6f)), medium, medium);
}

TEST(EmissionSampler, LightsAFloor) {
    SceneDescription s;
    const MediumId glow = add_glowing_grid(s, flame);
    add_floor(s);
    test::add_box(s, flame, test::add_interface(s), glow);
    const Scene scene(std::move(s));
    const Measured m = test::measure_radiance(scene, {{0, 0, 2}, {0, 0, -1}}, {100000, 0.0023}, 1);
    expect_agrees(m, reflected({0, 0, 0}, through_flame));
}

TEST(EmissionSampler, OnlyWhereTheMediumIs) {
    // The medium fills two balls; its grid is larger than either.
    SceneDescription s;
    const MediumId glow = add_glowing_grid(s, Box3(Vec3(-2, -2, 0.1f), Vec3(2, 2, 2.1f)));
    add_floor(s);
    const int interface = test::add_interface(s);
    const Vec3 centres[2] = {{0.8f, 0.1f, 0.9f}, {-0.9f, -0.2f, 1.2f}};
    const float radii[2] = {0.5f, 0.3f};
    for (int i = 0; i < 2; ++i) {
        test::add_sphere(s, centres[i], radii[i], interface, glow);
    }
    const Scene scene(std::move(s));
    const auto ball = [&](int i) {
        return [=, centre = centres[i], radius = radii[i]](const Ray& ray) {
            const float middle = dot(centre - ray.origin, ray.direction);
            const float square = sqr(radius) - length_squared(ray.at(middle) - centre);
            return middle > 0 && square > 0 ? Chord{2 * std::sqrt(square), middle - std::sqrt(square)} : Chord{};
        };
    };
    const Measured m = test::measure_radiance(scene, {{0, 0, 2}, {0, 0, -1}}, {2000000, 0.0023}, 1);
    // No ray from the floor's middle passes both.
    expect_agrees(m, reflected({0, 0, 0}, ball(0)) + reflected({0, 0, 0}, ball(1)));
}

TEST(EmissionSampler, SurroundsTheFloor) {
    // The floor and the camera are inside of the medium: no density of connections bounds what is near.
    SceneDescription s;
    const Box3 room(Vec3(-1, -1, -1), Vec3(1, 1, 1));
    const MediumId glow = add_glowing_grid(s, room);
    test::add_box(s, room, test::add_interface(s), glow);
    test::add_parallelogram(s, {-0.5f, -0.5f, 0}, {1, 0, 0}, {0, 1, 0}, test::add_diffuse(s, Rgb(0.6f)), glow, glow);
    s.camera_medium = glow;
    const Scene scene(std::move(s));
    const Vec3 p(0.1f, 0.05f, 0);
    const Shape around = [&](const Ray& ray) {
        float t0 = 0, t1 = 100;
        return clip_to_box(room, ray.origin, ray.direction, t0, t1) ? Chord{t1, 0} : Chord{};
    };
    const Measured m = test::measure_radiance(scene, {p + Vec3(0, 0, 0.8f), {0, 0, -1}}, {120000, 0.0023}, 1);
    expect_agrees(m, static_cast<double>(glowing(0.8f)) + std::exp(-flame_absorption * 0.8f) * reflected(p, around));
}

TEST(EmissionSampler, LightsFog) {
    // Single scattering; the flame stands in fog, whose transmittance counts on both ways.
    constexpr float g = 0.5f;
    const Rgb scattering(0.4f), fog_absorption(0.1f);
    constexpr double extinction = 0.5;
    SceneDescription s;
    const MediumId glow = add_glowing_grid(s, flame);
    const MediumId fog = test::add_homogeneous(s, fog_absorption, scattering, g);
    const int interface = test::add_interface(s);
    test::add_box(s, flame, interface, glow, fog);
    test::add_box(s, Box3(Vec3(-3), Vec3(3)), interface, fog);
    s.camera_medium = fog;
    const Scene scene(std::move(s));
    const Ray ray{{-0.2f, 0, 3}, {0, 0, -1}};
    double expected = 0;
    constexpr int steps = 48;
    const HenyeyGreenstein phase{g};
    for (int i = 0; i < steps; ++i) {
        const double t = 6 * (i + 0.5) / steps;
        expected += 6.0 / steps * 0.4 * std::exp(-extinction * t) *
                    arriving(ray.at(static_cast<float>(t)), through_flame, [&](const Vec3& w, const Chord& chord) {
                        return static_cast<double>(phase.evaluate(dot(w, ray.direction))) *
                               std::exp(-extinction * static_cast<double>(chord.before));
                    });
    }
    expect_agrees(test::measure_radiance(scene, ray, {300000, 0.0023}, 1), expected);
}

TEST(EmissionSampler, IsALightOfTheSceneWhereItIsUsed) {
    SceneDescription s;
    const MediumId glow = add_glowing_grid(s, flame);
    add_floor(s);
    s.lights.push_back(PointLight{{0, 0, 3}, Rgb(1.0f)});
    {
        const Scene unused(s);
        EXPECT_EQ(unused.lights().size(), 1u);
        EXPECT_EQ(unused.medium_light(glow), -1);
    }
    test::add_box(s, flame, test::add_interface(s), glow);
    const Scene scene(std::move(s));
    ASSERT_EQ(scene.lights().size(), 2u);
    EXPECT_EQ(scene.medium_light(glow), 1);
    EXPECT_EQ(scene.description().lights.size(), 1u);
    EXPECT_NEAR(light_power(scene.lights()[1], 1),
                4 * pi * flame_absorption * flame_radiance * flame.size().x * flame.size().y * flame.size().z, 1e-2);
}

}  // namespace
}  // namespace wend
