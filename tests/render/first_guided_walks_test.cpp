// The first guided walks of `full`, the trial after them, and the stages of the film that they begin: the picture's
// mean stays what it is by classical walks, by few samples and by many.
#include <tests/support/channel_means.h>
#include <tests/support/scenes.h>

#include <wend/render/render.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

/// So many pixels that a few guided walks come before the trial.
constexpr int side = 80;

/// A room full of coloured fog that scatters back, with a lamp, and a screen before it.
Scene foggy_room() {
    SceneDescription s = test::scene_with_camera({0, 0, -0.9f}, {0, 0, 1}, 60, side);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.02f, 0.06f, 0.1f), Rgb(0.5f, 0.4f, 0.2f), -0.4f);
    s.camera_medium = fog;
    const int wall = test::add_diffuse(s, Rgb(0.7f, 0.6f, 0.5f));
    test::add_box(s, Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)), wall, fog);
    test::add_box(s, Box3(Vec3(-0.6f, 0.2f, -0.3f), Vec3(0.2f, 0.25f, 0.5f)), wall, vacuum, fog);
    test::add_lamp(s, {-0.8f, 0.95f, -0.8f}, 1.6f, Rgb(2.0f), test::add_diffuse(s, Rgb(0.0f)));
    return Scene(std::move(s));
}

struct Renders {
    test::ChannelMeans means;
    RenderStatistics last;
};

Renders rendered(const Scene& scene, const char* preset, int samples, int seeds) {
    Renders renders;
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = samples;
    settings.max_depth = 4;
    for (settings.seed = 1; settings.seed <= static_cast<std::uint64_t>(seeds); ++settings.seed) {
        Film film({side, side}, {{0, 0}, {side, side}});
        renders.last = render(scene, film, settings);
        renders.means.add(film.beauty());
    }
    return renders;
}

TEST(FirstGuidedWalksSlow, LeaveTheMeanAsItIs) {
    const Scene scene = foggy_room();
    const test::ChannelMeans expected = rendered(scene, "classical", 64, 12).means;
    struct Budget {
        int samples, seeds;
    };
    for (const Budget budget : {Budget{4, 48}, Budget{7, 32}, Budget{16, 24}, Budget{64, 8}}) {
        const Renders found = rendered(scene, "full", budget.samples, budget.seeds);
        if (budget.samples == 7) {
            EXPECT_GT(found.last.kinds.back().share, 0.02) << "no walks before the trial";
            EXPECT_LT(found.last.kinds.back().share, 0.1) << "no trial yet";
        }
        for (int c = 0; c < 3; ++c) {
            const double error = std::hypot(expected[c].standard_error(), found.means[c].standard_error());
            EXPECT_NEAR(found.means[c].mean(), expected[c].mean(), 4 * error)
                << budget.samples << " samples, channel " << c;
            EXPECT_LT(4 * error, 0.01 * expected[c].mean()) << budget.samples << " samples: 1 % would not be seen";
        }
    }
}

}  // namespace
}  // namespace wend
