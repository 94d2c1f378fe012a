// Glass that is coloured at its surface, against a closed form, and against glass that walks meet otherwise.
#include <tests/support/channel_means.h>
#include <tests/support/scenes.h>

#include <wend/medium/fresnel.h>
#include <wend/render/render.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

constexpr int glass_side = 8;
const Rgb glass_reflectance(0.9f, 0.6f, 0.3f), glass_transmittance(0.4f, 0.7f, 1.0f);

int add_coloured_glass(SceneDescription& s, float ior, float alpha) {
    const int material = test::add_dielectric(s, ior, alpha);
    auto& glass = std::get<DielectricMaterial>(s.materials.back());
    glass.reflectance = s.textures.add_constant(glass_reflectance);
    glass.transmittance = s.textures.add_constant(glass_transmittance);
    return material;
}

Image picture_of_glass(const Scene& scene, const char* preset, int samples, std::uint64_t seed) {
    Film film({glass_side, glass_side}, {{0, 0}, {glass_side, glass_side}});
    RenderSettings settings;
    settings.samples = samples;
    settings.preset = parse_preset(preset);
    settings.seed = seed;
    settings.max_depth = 1 << 30;
    render(scene, film, settings);
    return film.beauty();
}

test::ChannelMeans means(const SceneDescription& description, const char* preset, int samples,
                         std::uint64_t count = 8) {
    const Scene scene(description);
    test::ChannelMeans result;
    for (std::uint64_t seed = 0; seed < count; ++seed) {
        result.add(picture_of_glass(scene, preset, samples, seed));
    }
    return result;
}

TEST(ColouredGlass, APaneInAnEvenSkyHasItsSeries) {
    SceneDescription s = test::scene_with_camera({0, 5, 0}, {0, 0, 0}, 0.5f, glass_side);
    test::add_box(s, Box3(Vec3(-9, -1, -9), Vec3(9, 0, 9)), add_coloured_glass(s, 1.5f, 0));
    test::add_environment(s, Rgb(1.0f));
    const float r = fresnel_dielectric(1.0f, 1.5f);
    for (const char* preset : {"classical", "direction", "full"}) {
        const auto measured = means(s, preset, 64);
        for (int c = 0; c < 3; ++c) {
            const double back = r * glass_reflectance[c], through = glass_transmittance[c];
            const double expected = back + std::pow(through * (1 - r), 2) / (1 - back);
            EXPECT_NEAR(measured[c].mean(), expected, 4 * measured[c].standard_error() + 1e-4) << preset << " " << c;
            EXPECT_LT(measured[c].standard_error(), 0.0025 * expected) << preset << " " << c;
        }
    }
}

// Through smooth glass collisions are connected to the lamp, along the way that it refracts; through glass that is a
// little rough they are not.
TEST(SlowColouredGlass, WhatScattersInsideIsLitAsThroughGlassThatIsNearlySmooth) {
    const auto lit = [](float alpha) {
        SceneDescription s = test::scene_with_camera({0, 6, 0.5f}, {0, 0, 0}, 20, glass_side);
        const MediumId inside = test::add_homogeneous(s, Rgb(0.2f), Rgb(1.0f));
        test::add_box(s, Box3(Vec3(-3, -1, -3), Vec3(3, 0, 3)), add_coloured_glass(s, 1.3f, alpha), inside);
        test::add_lamp(s, {-4, 3, -3}, 6, Rgb(5.0f), test::add_diffuse(s, Rgb(0.0f)));
        return s;
    };
    const auto rough =
        test::kept_means("nearly_smooth_glass", [&] { return means(lit(0.01f), "classical", 4096, 16).known(); });
    const Scene scene(lit(0));
    const auto smooth = test::means_until_seen(
        0.02, rough, 64, [&](std::uint64_t seed) { return picture_of_glass(scene, "classical", 1024, seed); });
    test::expect_known(smooth, rough, 0.02);
}

}  // namespace
}  // namespace wend
