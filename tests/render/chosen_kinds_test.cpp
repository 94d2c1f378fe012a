// What a render says of the kinds of walks that it has tried.
#include <tests/support/scenes.h>

#include <wend/render/render.h>

#include <gtest/gtest.h>

namespace wend {
namespace {

constexpr int lit_floor_side = 48;

/// A floor under a lamp that is seen, a thousand times as bright as the floor.
SceneDescription lamp_over_floor() {
    SceneDescription s = test::scene_with_camera({0, 9, 0.5f}, {0, 0, 0}, 40, lit_floor_side);
    test::add_box(s, Box3(Vec3(-9, -1, -9), Vec3(9, 0, 9)), test::add_diffuse(s, Rgb(0.5f)));
    test::add_lamp(s, {-0.5f, 3, -0.5f}, 1, Rgb(100.0f), test::add_diffuse(s, Rgb(0.0f)));
    return s;
}

// Errors are relative to their pixel from the first walk that counts: the few pixels at the lamp's edges would speak
// for the picture otherwise, and only for the kind that was there before pixels were known.
TEST(ChosenKinds, WhatIsAsGoodIsCalledSoWhereALampIsSeen) {
    const Scene scene(lamp_over_floor());
    for (const char* preset : {"full", "full+uniform"}) {
        for (const int samples : {15, 63}) {
            Film film({lit_floor_side, lit_floor_side}, {{0, 0}, {lit_floor_side, lit_floor_side}});
            RenderSettings settings;
            settings.samples = samples;
            settings.preset = parse_preset(preset);
            settings.max_depth = 2;  // direct light alone: all kinds connect to the lamp in the same way
            settings.seed = 5;
            const RenderStatistics statistics = render(scene, film, settings);
            ASSERT_EQ(statistics.kinds.size(), 3u) << preset;
            const double classical = statistics.kinds[0].squared_error, survival = statistics.kinds[1].squared_error;
            ASSERT_GT(survival, 0) << preset << " " << samples;
            EXPECT_NEAR(classical / survival, 1, 0.5) << preset << " " << samples;
        }
    }
}

}  // namespace
}  // namespace wend
