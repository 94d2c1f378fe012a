// Errors fall as one over the samples for as long as one likes: nothing is left that more samples do not take away.
#include <tests/support/scenes.h>

#include <wend/film/film.h>
#include <wend/render/render.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

constexpr int equilibrium_resolution = 4;

/// Within a ball of a medium that shines as much as it absorbs, under a sky as bright: every ray brings 1.
Scene equilibrium() {
    SceneDescription s = test::scene_with_camera({0.2f, -0.3f, -0.4f}, {0, 0, 0}, 60, equilibrium_resolution);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.3f), Rgb(2.0f), 0.5f);
    std::get<HomogeneousMedium>(s.media.back()).emission = Rgb(0.3f);
    s.camera_medium = fog;
    test::add_sphere(s, Vec3(0.0f), 1, test::add_interface(s), fog);
    test::add_environment(s, Rgb(1.0f));
    return Scene(s);
}

/// The mean square of what pixels are off by, over a few pictures.
double squared_error(const Scene& scene, const char* preset, int samples) {
    constexpr int pictures = 4;
    double sum = 0;
    for (int i = 0; i < pictures; ++i) {
        RenderSettings settings;
        settings.preset = parse_preset(preset);
        settings.subsurface = parse_subsurface("classical");
        settings.samples = samples;
        settings.seed = static_cast<std::uint64_t>(i);
        settings.max_depth = 100000;
        Film film({equilibrium_resolution, equilibrium_resolution},
                  {{0, 0}, {equilibrium_resolution, equilibrium_resolution}});
        render(scene, film, settings);
        for (const Rgb& pixel : film.beauty().pixels) {
            const double off = static_cast<double>(mean_value(pixel)) - 1;
            sum += off * off / (pictures * equilibrium_resolution * equilibrium_resolution);
        }
    }
    return sum;
}

class NoFloorSlow : public testing::TestWithParam<const char*> {};

// Of 64 values each; the logarithm of their ratio has a standard deviation of a quarter.
TEST_P(NoFloorSlow, ErrorsFallAsOneOverTheSamples) {
    const Scene scene = equilibrium();
    const double few = squared_error(scene, GetParam(), 32), many = squared_error(scene, GetParam(), 32 * 64);
    EXPECT_GT(few, 1e-4) << "there is something to take away";
    EXPECT_LT(many, 2 * few / 64);
}

INSTANTIATE_TEST_SUITE_P(Presets, NoFloorSlow, testing::Values("classical", "full"));

}  // namespace
}  // namespace wend
