// Walks inside dense media that are guided there by a strategy and elsewhere by what the render learns.
#include <tests/support/kept_means.h>
#include <tests/support/scenes.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

constexpr int training_resolution = 12;

/// A block of wax and a rough ball of honey in a box of thin fog on a grey floor, under a sky and a wide lamp.
SceneDescription wax_and_honey() {
    SceneDescription s = test::scene_with_camera({0, 1.2f, -5}, {0, -0.2f, 0}, 26, training_resolution);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.01f), Rgb(0.05f));
    const MediumId wax = test::add_homogeneous(s, {0.2f, 0.5f, 1.5f}, {15, 14, 12}, 0.3f);
    const MediumId honey = test::add_homogeneous(s, {0.3f, 0.8f, 2}, Rgb(10.0f), 0.6f);
    test::add_box(s, Box3(Vec3(-2, -1, -1.5f), Vec3(2, 1.5f, 1.5f)), test::add_interface(s), fog);
    test::add_box(s, Box3(Vec3(-1.1f, -0.9f, -0.5f), Vec3(-0.1f, 0.6f, 0.5f)), test::add_interface(s), wax, fog);
    test::add_sphere(s, {0.9f, -0.2f, 0}, 0.7f, test::add_dielectric(s, 1.4f, 0.3f), honey, fog);
    test::add_parallelogram(s, {-4, -1.001f, -4}, {0, 0, 8}, {8, 0, 0}, test::add_diffuse(s, Rgb(0.5f)));
    const Vec3 p(-3, 3, -2);
    s.lights.push_back(make_triangle_light(p, p + Vec3(5, 0, 0), p + Vec3(0, 0, 5), true, Rgb(2.0f), true));
    Surface lamp{TriangleMesh{{p, p + Vec3(5, 0, 0), p + Vec3(0, 0, 5)}, {}, {}, {0, 1, 2}},
                 s.surfaces.back().material};
    lamp.first_light = 0;
    s.world_surfaces.push_back(static_cast<int>(s.surfaces.size()));
    s.surfaces.push_back(std::move(lamp));
    test::add_environment(s, {0.4f, 0.5f, 0.6f});
    return s;
}

/// The mean of the picture, over independent renders.
Moments render_means(const Scene& scene, const char* sampling, const char* subsurface, std::uint64_t first_seed,
                     std::uint64_t replicas) {
    Moments means;
    for (std::uint64_t i = 0; i < replicas; ++i) {
        Film film({training_resolution, training_resolution}, {{0, 0}, {training_resolution, training_resolution}});
        RenderSettings settings;
        settings.preset = parse_preset(sampling);
        settings.subsurface = parse_subsurface(subsurface);
        settings.samples = 24;
        settings.seed = first_seed + i;
        settings.max_depth = 100000;
        render(scene, film, settings);
        double sum = 0;
        for (const Rgb& pixel : film.beauty().pixels) {
            sum += luminance(pixel);
        }
        means.add(sum / (training_resolution * training_resolution));
    }
    return means;
}

// Two ways, 20 renders of 12 x 12 pixels by 24 samples each: 140 thousand samples of long walks.
TEST(SlowSubsurfaceTraining, GivesTheSamePictureAsClassicalSampling) {
    const Scene scene(wax_and_honey());
    const test::KnownMean classical = test::kept_means("subsurface_training", [&] {
                                          const Moments means =
                                              render_means(scene, "classical", "classical", 1000, 120);
                                          return std::vector{test::KnownMean{means.mean(), means.standard_error()}};
                                      }).front();
    for (const char* subsurface : {"dwivedi", "auto"}) {
        SCOPED_TRACE(subsurface);
        const Moments full = render_means(scene, "full", subsurface, 2000, 20);
        const double error = std::hypot(classical.standard_error, full.standard_error());
        EXPECT_TRUE(agrees(full.mean() - classical.mean, error, 0, 4))
            << full.mean() << " and " << classical.mean << " +- " << error;
        EXPECT_FALSE(agrees(1.03 * full.mean() - classical.mean, error, 0, 4)) << "a bias of 3 % must be seen";
    }
}

}  // namespace
}  // namespace wend
