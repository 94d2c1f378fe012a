// The first guided walks of `full`, the trial after them, and the stages of the film that they begin: the picture's
// mean stays what it is by classical walks, by few samples and by many.
#include <tests/support/channel_means.h>
#include <tests/support/scenes.h>

#include <wend/render/render.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

/// Of a picture of so many pixels that a few guided walks come before the trial.
constexpr int tried_side = 80;

/// A room full of coloured fog that scatters back, with a lamp, and a screen before it.
Scene foggy_room(int side) {
    SceneDescription s = test::scene_with_camera({0, 0, -0.9f}, {0, 0, 1}, 60, side);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.02f, 0.06f, 0.1f), Rgb(0.5f, 0.4f, 0.2f), -0.4f);
    s.camera_medium = fog;
    const int wall = test::add_diffuse(s, Rgb(0.7f, 0.6f, 0.5f));
    test::add_box(s, Box3(Vec3(-1, -1, -1), Vec3(1, 1, 1)), wall, fog);
    test::add_box(s, Box3(Vec3(-0.6f, 0.2f, -0.3f), Vec3(0.2f, 0.25f, 0.5f)), wall, vacuum, fog);
    test::add_lamp(s, {-0.8f, 0.95f, -0.8f}, 1.6f, Rgb(2.0f), test::add_diffuse(s, Rgb(0.0f)));
    return Scene(std::move(s));
}

RenderStatistics render_once(const Scene& scene, int side, const char* preset, int samples, std::uint64_t seed,
                             Image& picture) {
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = samples;
    settings.max_depth = 4;
    settings.seed = seed;
    Film film({side, side}, {{0, 0}, {side, side}});
    const RenderStatistics statistics = render(scene, film, settings);
    picture = film.beauty();
    return statistics;
}

TEST(FirstGuidedWalks, ComeAfterClassicalOnesInFogWhereARenderIsTooShortForThem) {
    // The smallest picture that is not guided in all ways from the start, and too small for a few guided walks.
    constexpr int side = 32;
    const Scene scene = foggy_room(side);
    const auto segments = [&](const char* preset, int samples, Image& picture) {
        return render_once(scene, side, preset, samples, 1, picture).counts.segments;
    };
    Image classical, plain;
    EXPECT_EQ(segments("full", 6, plain), segments("classical", 6, classical));
    EXPECT_TRUE(plain.pixels == classical.pixels);
    // Else they are longer, and teach more.
    EXPECT_GT(segments("full", 7, plain), segments("classical", 7, classical));
    EXPECT_FALSE(plain.pixels == classical.pixels);
}

TEST(FirstGuidedWalksSlow, LeaveTheMeanAsItIs) {
    const auto expected = test::kept_means("first_guided_walks", [&] {
        const Scene scene = foggy_room(tried_side);
        test::ChannelMeans means;
        for (std::uint64_t seed = 1000; seed < 1012; ++seed) {
            Image picture;
            render_once(scene, tried_side, "classical", 64, seed, picture);
            means.add(picture);
        }
        return means.known();
    });
    struct Budget {
        int samples, seeds, side;
    };
    for (const Budget budget : {Budget{4, 48, tried_side}, Budget{7, 32, tried_side}, Budget{16, 24, tried_side},
                                Budget{64, 24, tried_side / 2}}) {
        SCOPED_TRACE(budget.samples);
        const Scene scene = foggy_room(budget.side);
        RenderStatistics last;
        const test::ChannelMeans means = test::means_until_seen(0.01, expected, budget.seeds, [&](std::uint64_t seed) {
            Image picture;
            last = render_once(scene, budget.side, "full", budget.samples, seed, picture);
            return picture;
        });
        if (budget.samples == 7) {
            EXPECT_GT(last.kinds.back().share, 0.02) << "no walks before the trial";
            EXPECT_LT(last.kinds.back().share, 0.1) << "no trial yet";
        }
        test::expect_known(means, expected, 0.01);
    }
}

}  // namespace
}  // namespace wend
