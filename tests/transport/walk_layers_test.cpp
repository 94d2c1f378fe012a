// What pictures tell of the walks that made them, where it is known.
#include <tests/support/scenes.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

/// A layer of a small picture.
std::vector<float> walk_layer(const Scene& scene, const char* preset, int samples, int max_depth, const char* name) {
    constexpr int resolution = 16;
    Film film({resolution, resolution}, {{0, 0}, {resolution, resolution}});
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.sampler = SamplerKind::independent;
    settings.samples = samples;
    settings.max_depth = max_depth;
    render(scene, film, settings);
    const std::vector<Layer> layers = film.walk_layers();
    return std::find_if(layers.begin(), layers.end(), [&](const Layer& l) { return l.name == name; })->values;
}

double mean_of(const std::vector<float>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

TEST(WalkLayers, WalksBetweenMirrorsHaveOneSegmentForEach) {
    constexpr int mirrors = 12;
    SceneDescription s = test::scene_with_camera({0, 0, 0}, {0, 0, 1}, 0.1f, 16);
    ConductorMaterial mirror;
    mirror.reflectance = s.textures.add_constant(Rgb(1.0f));
    mirror.roughness.u = mirror.roughness.v = s.textures.add_constant(Rgb(0.0f));
    s.materials.push_back(mirror);
    const int material = static_cast<int>(s.materials.size()) - 1;
    test::add_parallelogram(s, {-10, -10, 1}, {0, 20, 0}, {20, 0, 0}, material);
    test::add_parallelogram(s, {-10, -10, -1}, {20, 0, 0}, {0, 20, 0}, material);
    const Scene scene(std::move(s));
    // The last segment finds the mirror at which the walk has no depth left. A mirror keeps 1 in 10 000.
    EXPECT_NEAR(mean_of(walk_layer(scene, "classical", 16, mirrors, "segments")), mirrors + 1, 0.05);
}

TEST(WalkLayers, InterfacesEndSegments) {
    SceneDescription s = test::scene_with_camera({0, 0, -5}, {0, 0, 0}, 0.1f, 16);
    const int boundary = test::add_interface(s);
    for (int i = 0; i < 4; ++i) {
        test::add_parallelogram(s, {-10, -10, static_cast<float>(i)}, {20, 0, 0}, {0, 20, 0}, boundary);
    }
    test::add_environment(s, Rgb(1.0f));
    const Scene scene(std::move(s));
    for (const float n : walk_layer(scene, "classical", 3, 10, "segments")) {
        EXPECT_EQ(n, 5);
    }
}

TEST(WalkLayers, OnlySplittingMakesBranches) {
    // A small sphere of thick fog with a lamp inside: from outside, the walks that come near it are worth splitting.
    SceneDescription s = test::scene_with_camera({0, 0, -4}, {0, 0, 0}, 40, 16);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.02f), Rgb(4.0f));
    test::add_sphere(s, {0, 0, 0}, 1, test::add_interface(s), fog);
    s.lights.push_back(PointLight{{0.3f, 0, 0}, Rgb(1.0f)});
    const Scene scene(std::move(s));
    for (const char* preset : {"classical", "distance+direction", "roulette"}) {
        for (const float n : walk_layer(scene, preset, 32, 100, "branches")) {
            ASSERT_EQ(n, 1) << preset;
        }
    }
    EXPECT_GT(mean_of(walk_layer(scene, "splitting", 64, 100, "branches")), 1.01);
}

}  // namespace
}  // namespace wend
