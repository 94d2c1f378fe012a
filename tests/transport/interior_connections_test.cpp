// What walks in dense media run into and what their connections find are the same light, weighed once in all.
#include <tests/support/scenes.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

using test::Measured;

constexpr const char* connected_strategies[] = {"dwivedi", "auto"};

/// A dense slab under a white sky that shines on it from above only.
SceneDescription slab(float albedo) {
    constexpr float thickness = 30;
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, Rgb((1 - albedo) * thickness), Rgb(albedo * thickness));
    test::add_box(s, Box3(Vec3(-2, -2, 0), Vec3(2, 2, 1)), test::add_interface(s), medium);
    test::add_parallelogram(s, Vec3(-1e5f, -1e5f, 1.5f), Vec3(2e5f, 0, 0), Vec3(0, 2e5f, 0),
                            test::add_diffuse(s, Rgb(0.0f)));
    test::add_environment(s, Rgb(1.0f));
    return s;
}

// Boundaries of regions that are larger, and so say nothing of the medium, cross the slab beneath its surface.
TEST(SlowInteriorConnections, GoOnBehindBoundariesThatTheirMediumGoesOnBehind) {
    constexpr float albedo = 0.4f;
    SceneDescription s = slab(albedo);
    const MediumId nothing = test::add_homogeneous(s, Rgb(0.0f), Rgb(1e-6f));
    const int interface = test::add_interface(s);
    for (const float depth : {0.01f, 0.02f, 0.03f, 0.05f}) {
        test::add_box(s, Box3(Vec3(-9 - depth, -9, -1), Vec3(9, 9, depth)), interface, nothing);
    }
    const Scene scene(std::move(s));
    // Once scattered: albedo / 2 times the integral of mu / (1 + mu) over the directions in.
    const double expected = double{albedo} / 2 * (1 - std::log(2.0));
    for (const char* strategy : connected_strategies) {
        const Measured m = test::measure_radiance(scene, {{0.3f, 0.1f, -2}, {0, 0, 1}}, {8000000, 0.0012}, 1, 1,
                                                  parse_subsurface(strategy));
        EXPECT_TRUE(agrees(m.mean, m.standard_error, expected, 4, 1e-5))
            << strategy << ' ' << m.mean << " +- " << m.standard_error << " expected " << expected;
        EXPECT_LT(8 * m.standard_error, 0.01 * expected) << "too few walks to see a bias of 1 %";
    }
}

/// A murky ball behind smooth glass, under a black lamp that is there for this part of the rays.
Scene under_lamp(float presence) {
    SceneDescription s;
    const MediumId medium = test::add_homogeneous(s, Rgb(2.0f), Rgb(8.0f));
    test::add_sphere(s, {0, 0, 0}, 1, test::add_dielectric(s, 1.3f), medium);
    test::add_lamp(s, {-20, 4, -20}, 80, Rgb(2.0f), test::add_diffuse(s, Rgb(0.0f)));
    if (presence < 1) {
        s.surfaces.back().alpha = s.textures.add_constant(Rgb(presence));
        std::get<TriangleLight>(s.lights.back()).presence = Presence::partly;
    }
    return Scene(std::move(s));
}

// All light comes through glass. So rays that meet the lamp find it with its presence, as those that met it before a
// connection could have: with the square of it.
TEST(InteriorConnections, LeaveLampsThatArePartlyThereAsTheyAreBehindGlass) {
    constexpr float presence = 0.5f;
    // The glass mirrors it downwards: whether the lamp is there for one ray is always the same.
    const Ray ray{{0.1f, -0.2f, -4}, {0, 0, 1}};
    const Measured all = test::measure_radiance(under_lamp(1), ray, {500000, 0.008});
    const Scene scene = under_lamp(presence);
    for (const char* strategy : connected_strategies) {
        const Measured partly =
            test::measure_radiance(scene, ray, {500000, 0.008}, 100000, 2, parse_subsurface(strategy));
        const double expected = all.mean * sqr(double{presence});
        const double error = std::hypot(partly.standard_error, all.standard_error * sqr(double{presence}));
        EXPECT_TRUE(agrees(partly.mean - expected, error, 0, 4))
            << strategy << ' ' << partly.mean << " and " << expected << " +- " << error;
        EXPECT_LT(8 * error, 0.1 * expected) << "too few walks to see a bias of 10 %";
    }
}

}  // namespace
}  // namespace wend
