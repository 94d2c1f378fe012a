// Walks of a hundred thousand collisions: they end, and in bounded memory.
#include <tests/support/peak_memory.h>
#include <tests/support/scenes.h>

#include <wend/transport/path_tracer.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

/// In the middle of a sea of albedo 0.9999, a thousand times as wide as a flight is long, with a lamp.
SceneDescription sea() {
    SceneDescription s = test::scene_with_camera({0, 0, 0}, {0, 0, 1}, 40, 4);
    const MediumId medium = test::add_homogeneous(s, Rgb(0.0001f), Rgb(0.9999f));
    test::add_sphere(s, {0, 0, 0}, 1000, test::add_interface(s), medium);
    s.camera_medium = medium;
    s.lights.push_back(PointLight{{0, 0, 3}, Rgb(1.0f)});
    return s;
}

/// Walks never die of roulette, so that their length is known.
struct Immortal {
    std::optional<WeightWindow::Outcome> before_direction(const ExpectedContribution&, Pcg32&) const {
        return std::nullopt;
    }
    float after_direction(const WalkState&) const { return 1; }
};

struct EndlessDecisions {
    ClassicalDistance distance;
    ClassicalDirection direction;
    Immortal survival;
};

TEST(LongWalk, AHundredThousandCollisionsLeaveAFewRecords) {
    constexpr int collisions = 100000;
    constexpr std::size_t most_records = 64;
    const Scene scene(sea());
    const EndlessDecisions decisions;
    const SubsurfaceGuides unguided;
    const LightSelection lights(scene);
    const ReflectionProbability reflections(scene.bounds());
    const PathTracer tracer(scene, decisions, unguided, lights, reflections, collisions);
    guide::PathLog log;
    guide::PathRecords records;
    for (std::uint32_t i = 0; i < 3; ++i) {
        Sampler sampler(SamplerKind::independent, 1, 0, i);
        const WalkResult result =
            tracer.trace({{0, 0, 0}, {0, 0, 1}}, 0, sampler, StandardRecorders(FieldRecorder(&log), {}, {}, {}));
        EXPECT_TRUE(is_finite(result.sample.radiance));
        EXPECT_EQ(result.sample.segments, collisions + 1u);
        EXPECT_EQ(log.vertices().size(), static_cast<std::size_t>(collisions));
        records.add(log.vertices(), most_records);
        EXPECT_LE(records.volume().size(), (i + 1) * most_records);
        EXPECT_LE(records.volume_scattered().size(), (i + 1) * 2 * most_records);
    }
    EXPECT_GE(records.volume().size(), 3 * most_records / 2) << "the cap is no excuse to learn nothing";
}

class LongWalks : public testing::TestWithParam<const char*> {};

TEST_P(LongWalks, EndWithoutALimitOfDepthInBoundedMemory) {
    const Scene scene(sea());
    Film film({4, 4}, {{0, 0}, {4, 4}});
    RenderSettings settings;
    settings.preset = parse_preset(GetParam());
    settings.samples = 15;
    settings.max_depth = 1 << 30;
    settings.threads = 2;
    const test::PeakMemory memory;
    const RenderStatistics statistics = render(scene, film, settings);
    EXPECT_EQ(statistics.counts.rejected, 0u);
    // 16 MiB are one walk's vertices; a log for each thread, and the field.
    EXPECT_LT(memory.growth(), 256 << 20) << "bytes";
    for (const Rgb& pixel : film.beauty().pixels) {
        EXPECT_TRUE(is_finite(pixel) && min_value(pixel) >= 0);
    }
    if (settings.preset.is_classical()) {
        EXPECT_GT(statistics.counts.segments, 3000 * statistics.counts.paths) << "these walks are not long";
    }
}

INSTANTIATE_TEST_SUITE_P(Presets, LongWalks, testing::Values("classical", "full", "distance+direction+splitting"));

}  // namespace
}  // namespace wend
