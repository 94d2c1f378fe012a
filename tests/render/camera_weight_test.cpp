// Pictures of cameras whose rays do not all count the same.
#include <tests/support/channel_means.h>
#include <tests/support/scenes.h>
#include <wend/render/render.h>

#include <gtest/gtest.h>

#include <cmath>
#include <memory>

namespace wend {
namespace {

constexpr int lens_resolution = 8;

Camera camera_with_lenses() {
    // A wide opening, and a ring that takes light from the edge of the film.
    const std::vector<LensSurface> surfaces = {{0.1, 2e-3, 1.5, 0.03}, {-0.1, 0.03, 1, 0.02}, {1e4, 0.07, 1, 0.014}};
    const auto lenses = std::make_shared<const LensSystem>(surfaces, 2, 0.03);
    return Camera(RealisticCamera{lenses, Vec2(0.03f * std::sqrt(2.0f))}, Transform::translate(0, 0, -2),
                  lens_resolution, lens_resolution);
}

Image picture_through_lenses(const Scene& scene, const char* preset, int samples, std::uint64_t seed) {
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = samples;
    settings.max_depth = 20;
    settings.seed = seed;
    Film film({lens_resolution, lens_resolution}, {{0, 0}, {lens_resolution, lens_resolution}});
    render(scene, film, settings);
    return film.beauty();
}

test::ChannelMeans rendered(const Scene& scene, const char* preset, int samples, std::uint64_t renders) {
    test::ChannelMeans means;
    for (std::uint64_t seed = 1; seed <= renders; ++seed) {
        means.add(picture_through_lenses(scene, preset, samples, seed));
    }
    return means;
}

TEST(CameraWeight, AnEvenSkyIsAsBrightAsTheMeanOfTheWeights) {
    SceneDescription description;
    description.camera = camera_with_lenses();
    test::add_environment(description, Rgb(3, 2, 1));
    const Scene scene(std::move(description));
    const auto means = rendered(scene, "classical", 1000, 16);
    Moments weights;
    Pcg32 random(1);
    for (int i = 0; i < 1'000'000; ++i) {
        const Vec2 film = random.uniform2() * static_cast<float>(lens_resolution);
        weights.add(double{scene.camera().ray(film, random.uniform2()).weight});
    }
    for (int c = 0; c < 3; ++c) {
        const double error = std::hypot(means[c].standard_error(), (3 - c) * weights.standard_error());
        EXPECT_NEAR(means[c].mean(), (3 - c) * weights.mean(), 4 * error);
        EXPECT_LT(4 * error, 0.01 * means[c].mean());
    }
}

TEST(SlowCameraWeight, GuidedFogAgrees) {
    SceneDescription description;
    description.camera = camera_with_lenses();
    test::add_environment(description, Rgb(0.2f));
    const int interface = test::add_interface(description), floor = test::add_diffuse(description, Rgb(0.5f));
    const MediumId fog = test::add_homogeneous(description, Rgb(0.1f), Rgb(2, 3, 4), 0.3f);
    test::add_sphere(description, {0, 0, 0}, 0.4f, interface, fog);
    test::add_lamp(description, {0.2f, 0.8f, -0.3f}, 0.4f, Rgb(20), floor);
    test::add_parallelogram(description, {-2, -0.5f, -1}, {0, 0, 4}, {4, 0, 0}, floor);
    const Scene scene(std::move(description));
    const auto expected =
        test::kept_means("camera_weight", [&] { return rendered(scene, "classical", 2048, 16).known(); });
    test::expect_known(
        test::means_until_seen(0.03, expected, 16,
                               [&](std::uint64_t seed) { return picture_through_lenses(scene, "full", 256, seed); }),
        expected, 0.03);
}

}  // namespace
}  // namespace wend
