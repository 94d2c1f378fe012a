// Layers of what camera rays show: of the scene, and of nothing else.
#include <tests/support/scenes.h>

#include <wend/transport/first_surface.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

constexpr int slab_resolution = 16;

FilmFeatures seen(const SceneDescription& description) {
    const Scene scene(description);
    Pcg32 random(1);
    return first_surface(scene, scene.camera().middle(), random);
}

/// A camera in front of a slab of unit thickness at z = 0, in the light of an even sky.
SceneDescription slab(bool grid = false) {
    SceneDescription s = test::scene_with_camera({0, 0, -5}, {0, 0, 0}, 0.1f, slab_resolution);
    const Box3 box(Vec3(-100, -100, 0), Vec3(100, 100, 1));
    const MediumId medium =
        grid ? test::add_uniform_grid(s, box, Rgb(0.1f), Rgb(0.7f), 0) : test::add_homogeneous(s, Rgb(0.1f), Rgb(0.7f));
    test::add_box(s, box, test::add_interface(s), medium);
    test::add_environment(s, Rgb(1.0f));
    return s;
}

void add_wall(SceneDescription& s, float z, int material) {
    test::add_parallelogram(s, {-100, -100, z}, {0, 200, 0}, {200, 0, 0}, material);
}

TEST(FirstSurface, MediaHideNothingAndTellTheirOpacity) {
    for (const bool grid : {false, true}) {
        SceneDescription s = slab(grid);
        EXPECT_NEAR(seen(s).opacity, -std::expm1(-0.8f), 1e-4f);
        EXPECT_EQ(seen(s).depth, 0) << "nothing but sky";
        EXPECT_EQ(seen(s).alpha, seen(s).opacity) << "the sky is seen through it";
        add_wall(s, 3, test::add_diffuse(s, {0.5f, 0.25f, 0.125f}));
        const FilmFeatures behind = seen(s);
        EXPECT_NEAR(behind.depth, 8, 1e-4f);
        EXPECT_EQ(behind.albedo, Rgb(0.5f, 0.25f, 0.125f));
        EXPECT_NEAR(behind.normal.z, -1, 1e-6f);
        EXPECT_NEAR(behind.opacity, -std::expm1(-0.8f), 1e-4f);
        EXPECT_EQ(behind.alpha, 1);
        add_wall(s, -1, test::add_diffuse(s, Rgb(0.5f)));
        EXPECT_EQ(seen(s).opacity, 0) << "a wall before the fog";
        EXPECT_NEAR(seen(s).depth, 4, 1e-4f);
    }
}

TEST(FirstSurface, ObjectsCoverWhatAlphaSays) {
    SceneDescription s = slab();
    const auto objects_in = [](const SceneDescription& description) {
        const Scene scene(description);
        const ObjectIds ids{{1, 2, 3}, {7}};
        SeenObjects objects{ids};
        Pcg32 random(1);
        const FilmFeatures features = first_surface(scene, scene.camera().middle(), random, &objects);
        float sum = 0;
        for (const Coverage& each : objects.parts) {
            sum += each.part;
        }
        EXPECT_NEAR(sum, features.alpha, 1e-6f);
        return objects.parts;
    };
    const float fog = -std::expm1(-0.8f);
    auto parts = objects_in(s);
    ASSERT_EQ(parts.size(), 1u) << "the sky is none";
    EXPECT_EQ(parts[0].id, 7u);
    EXPECT_NEAR(parts[0].part, fog, 1e-4f);
    add_wall(s, 3, test::add_diffuse(s, Rgb(0.5f)));
    parts = objects_in(s);
    ASSERT_EQ(parts.size(), 2u);
    EXPECT_EQ(parts[1].id, 2u) << "the second surface of the scene";
    EXPECT_NEAR(parts[1].part, 1 - fog, 1e-4f);
    EXPECT_NEAR(seen(s).position.z, 3, 1e-5f);
    EXPECT_NEAR(seen(s).face_normal.z, -1, 1e-6f);
}

TEST(FirstSurface, WhatIsHeldOutIsAHoleAndWhatIsHiddenIsNotThere) {
    SceneDescription s = slab();
    add_wall(s, 3, test::add_diffuse(s, Rgb(0.25f)));
    add_wall(s, 2, test::add_diffuse(s, Rgb(0.5f)));
    s.surfaces.back().view = CameraView::hidden;
    EXPECT_NEAR(seen(s).depth, 8, 1e-4f);
    EXPECT_EQ(seen(s).albedo, Rgb(0.25f));
    s.surfaces.back().view = CameraView::held_out;
    EXPECT_EQ(seen(s).depth, 0);
    EXPECT_EQ(seen(s).albedo, Rgb(0.0f));
    EXPECT_EQ(seen(s).alpha, seen(s).opacity) << "the fog before it is there";
    EXPECT_GT(seen(s).opacity, 0);
}

TEST(FirstSurface, MirrorsAndGlassShowWhatIsSeenInThem) {
    SceneDescription s = test::scene_with_camera({0, 0, -5}, {0, 0, 0}, 0.1f, slab_resolution);
    add_wall(s, -100, test::add_diffuse(s, Rgb(0.5f)));
    EXPECT_EQ(seen(s).alpha, 0) << "there is nothing before the camera";
    s = test::scene_with_camera({0, 0, -5}, {0, 0, 0}, 0.1f, slab_resolution);
    ConductorMaterial mirror;
    mirror.reflectance = s.textures.add_constant(Rgb(0.9f, 0.6f, 0.3f));
    mirror.roughness.u = mirror.roughness.v = s.textures.add_constant(Rgb(0.0f));
    s.materials.push_back(mirror);
    add_wall(s, 0, static_cast<int>(s.materials.size()) - 1);
    EXPECT_NEAR(seen(s).depth, 5, 1e-4f) << "the mirror's";
    EXPECT_EQ(seen(s).albedo, Rgb(0.0f)) << "it shows nothing";
    EXPECT_EQ(seen(s).alpha, 1) << "the mirror's";
    add_wall(s, -7, test::add_diffuse(s, Rgb(0.5f)));
    const FilmFeatures reflected = seen(s);
    EXPECT_NEAR(reflected.depth, 5, 1e-4f);
    EXPECT_NEAR(reflected.albedo.r, 0.45f, 1e-3f);
    EXPECT_NEAR(reflected.albedo.b, 0.15f, 1e-3f);
    EXPECT_NEAR(std::abs(reflected.normal.z), 1, 1e-6f);
}

/// A foggy room with a mirror ball, which presets sample in very different ways.
SceneDescription room() {
    SceneDescription s = test::scene_with_camera({0, 0, -3.5f}, {0, 0, 0}, 40, slab_resolution);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.05f), Rgb(0.5f));
    test::add_box(s, Box3(Vec3(-1), Vec3(1)), test::add_interface(s), fog);
    test::add_parallelogram(s, {-1, -1, 0.9f}, {2, 0, 0}, {0, 2, 0}, test::add_diffuse(s, {0.7f, 0.3f, 0.1f}));
    test::add_sphere(s, {0.4f, -0.4f, 0}, 0.4f, test::add_dielectric(s, 1.5f), vacuum, fog);
    s.lights.push_back(PointLight{{-0.6f, 0.7f, 0}, Rgb(3.0f)});
    return s;
}

Picture rendered(const Scene& scene, const char* preset, std::uint64_t seed) {
    Film film({slab_resolution, slab_resolution}, {{0, 0}, {slab_resolution, slab_resolution}});
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = 20;
    settings.max_depth = 20;
    settings.seed = seed;
    render(scene, film, settings);
    return film.picture();
}

const std::vector<float>& layer(const Picture& picture, const std::string& name) {
    return std::find_if(picture.layers.begin(), picture.layers.end(), [&](const Layer& l) { return l.name == name; })
        ->values;
}

TEST(FirstSurface, LayersAreTheSameForEveryPreset) {
    const Scene scene(room());
    const Picture classical = rendered(scene, "classical", 1), other_rays = rendered(scene, "classical", 2);
    const std::string names[] = {"albedo", "normal", "depth", "scatter", "alpha"};
    for (const char* preset : {"full", "distance+direction", "roulette+splitting"}) {
        const Picture picture = rendered(scene, preset, 1);
        for (const std::string& name : names) {
            // The rays are the same, and so is what they show.
            EXPECT_EQ(layer(picture, name), layer(classical, name)) << preset << ' ' << name;
        }
        if (preset == std::string("distance+direction")) {
            EXPECT_NE(layer(picture, "segments"), layer(classical, "segments")) << "what walks did is another matter";
        }
    }
    for (const std::string& name : names) {
        EXPECT_NE(layer(other_rays, name), layer(classical, name)) << "other rays show a little else: " << name;
    }
}

}  // namespace
}  // namespace wend
