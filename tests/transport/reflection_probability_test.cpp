// Choices between reflection and refraction that were learned: what they learn, and that pictures interior walk the
// same.
#include <tests/support/repeated_renders.h>
#include <tests/support/scenes.h>

#include <wend/light/scattering.h>
#include <wend/transport/reflection_probability.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

namespace wend {
namespace {

const Box3 room_bounds(Vec3(-1), Vec3(1));
const LightReceiver facing_up{{0.5f, 0.5f, 0.5f}, {0, 0, 1}}, facing_down{{0.5f, 0.5f, 0.5f}, {0, 0, -1}};

TEST(ReflectionProbability, AreFresnelsUntilSomethingIsKnown) {
    ReflectionProbability choices(room_bounds);
    EXPECT_EQ(choices.odds(facing_up), 1);
    choices.learn();
    EXPECT_EQ(choices.odds(facing_up), 1);
    const std::vector<ReflectionRecord> dark(100, choices.record(facing_up, true, 0));
    choices.add(dark);
    choices.learn();
    EXPECT_EQ(choices.odds(facing_up), 1);
}

TEST(ReflectionProbability, FollowTheRatioOfWhatWasBrought) {
    ReflectionProbability choices(room_bounds);
    std::vector<ReflectionRecord> records;
    for (int i = 0; i < 10000; ++i) {
        // Five on the one way, one on the other, as means.
        records.push_back(choices.record(facing_up, i % 4 == 0, i % 4 == 0 ? 5 : i % 2 == 0 ? 3.0f : 0.0f));
        records.push_back(choices.record(facing_down, i % 4 == 0, i % 4 == 0 ? 0.0f : 1));
    }
    records.push_back(choices.record(facing_up, true, std::numeric_limits<float>::infinity()));
    records.push_back(choices.record(facing_up, true, std::numeric_limits<float>::quiet_NaN()));
    choices.add(records);
    EXPECT_EQ(choices.odds(facing_up), 1) << "before the lesson";
    choices.learn();
    EXPECT_NEAR(choices.odds(facing_up), 5, 0.1f);
    // No way is ruled out.
    EXPECT_GT(choices.odds(facing_down), 1.0f / 65);
    EXPECT_LT(choices.odds(facing_down), 1.0f / 60);
    EXPECT_EQ(choices.odds({{-0.5f, 0.5f, 0.5f}, {0, 0, 1}}), 1) << "elsewhere";
}

TEST(ReflectionProbability, FewRecordsSayLittle) {
    ReflectionProbability choices(room_bounds);
    const std::vector<ReflectionRecord> records = {choices.record(facing_up, true, 100),
                                                   choices.record(facing_up, false, 1)};
    choices.add(records);
    choices.learn();
    EXPECT_GT(choices.odds(facing_up), 1);
    EXPECT_LT(choices.odds(facing_up), 1.5f);
}

TEST(ReflectionProbability, NoneMakesAWalkTooHeavy) {
    const Vec3 before = normalize(Vec3(0.2f, 0, -1));
    for (const float odds : {1.0f / 64, 64.0f}) {
        for (const float weight : {0.2f, 1.0f, 2.0f, 5.0f}) {
            SurfaceScattering f(DielectricBsdf{1.5f, 0, 0}, Frame::from_z({0, 0, 1}), before);
            f.prefer_reflection(odds, weight);
            float least = 1;
            for (int i = 0; i < 1000; ++i) {
                least = std::min(least, f.sample(static_cast<float>(i) / 1000, {0.5f, 0.5f})->density_ratio);
            }
            EXPECT_GE(least, std::min(1.0f, weight / weight_bound) * 0.9999f) << odds << ' ' << weight;
            EXPECT_LT(least, std::max(0.8f, weight / weight_bound)) << odds << ' ' << weight;
        }
    }
}

TEST(ReflectionLog, TellsEveryBoundaryOfATree) {
    const ReflectionProbability choices(room_bounds);
    ReflectionLog log;
    log.start();
    const int first = log.note(ReflectionLog::none, choices.record(facing_up, true, 0), 0.5f);
    log.bring(first, 1);
    const int left = log.note(first, choices.record(facing_up, false, 0), 0.25f);
    const int right = log.note(first, choices.record(facing_down, true, 0), 2);
    log.bring(left, 3);
    log.bring(right, 8);
    log.bring(ReflectionLog::none, 100);
    std::vector<ReflectionRecord> records;
    log.finish(records);
    ASSERT_EQ(records.size(), 3u);
    EXPECT_EQ(records[0].brought, 4);
    EXPECT_TRUE(records[0].reflected);
    EXPECT_EQ(records[1].brought, 12);
    EXPECT_FALSE(records[1].reflected);
    EXPECT_EQ(records[2].brought, 24);
    log.finish(records);
    EXPECT_EQ(records.size(), 3u) << "a walk is told once";
}

TEST(ReflectionLog, KeepsWhatIsFoundAfterItIsFull) {
    const ReflectionProbability choices(room_bounds);
    ReflectionLog log;
    log.start();
    const int first = log.note(ReflectionLog::none, choices.record(facing_up, true, 0), 1);
    for (std::size_t i = 1; i < ReflectionLog::most; ++i) {
        log.note(first, choices.record(facing_up, false, 0), 1);
    }
    log.bring(log.note(first, choices.record(facing_down, false, 0), 1), 5);
    std::vector<ReflectionRecord> records;
    log.finish(records);
    ASSERT_EQ(records.size(), ReflectionLog::most);
    EXPECT_EQ(records.back().brought, 5) << "the first boundary's";
}

constexpr int glass_resolution = 6;

struct Glass {
    float roughness;
    /// By 192 classical renders of 4096 samples a pixel each with the seeds from 100000 on: 28 million samples.
    test::KnownMean mean;
};

void PrintTo(const Glass& glass, std::ostream* out) {
    *out << glass.roughness;
}

class DarkGlass : public testing::TestWithParam<Glass> {};

// Eight classical renders of 6 x 6 pixels by 2304 samples each, and two ways of guiding by sixteen or more: 3 million
// samples. The guided means have standard errors of 0.15 % at most, the known ones of 0.06 %.
TEST_P(DarkGlass, LooksTheSameWithLessNoise) {
    // Murky glass under a bright sky: a few per cent that are reflected are a third of what is seen.
    SceneDescription s = test::scene_with_camera({0, 0, -4}, {0, 0, 0}, 20, glass_resolution);
    const MediumId murk = test::add_homogeneous(s, Rgb(6.0f), Rgb(10.0f), 0.3f);
    test::add_sphere(s, {0, 0, 0}, 1, test::add_dielectric(s, 1.5f, GetParam().roughness), murk);
    test::add_environment(s, Rgb(1.0f));
    const Scene scene(std::move(s));
    RenderSettings settings;
    settings.samples = 2304;
    settings.max_depth = 200;
    // What a choice adds to the noise of one sample, not how well samples are spread over it.
    settings.sampler = SamplerKind::independent;
    settings.seed = 1000;
    // Its noise alone: its mean is known.
    const test::RepeatedRenders classical(scene, settings, glass_resolution, {8, 8});
    settings.seed = 2000;
    for (const auto& [sampling, subsurface] : {std::pair("direction", "classical"), {"full", "auto"}}) {
        SCOPED_TRACE(testing::Message() << sampling << ", " << subsurface);
        settings.preset = parse_preset(sampling);
        settings.subsurface = parse_subsurface(subsurface);
        const test::RepeatedRenders guided(scene, settings, glass_resolution);
        test::expect_mean(guided, GetParam().mean);
        EXPECT_LT(guided.noise, 0.7 * classical.noise) << classical.noise;
    }
}

INSTANTIATE_TEST_SUITE_P(SlowRoughness, DarkGlass,
                         testing::Values(Glass{0, {0.09796447, 0.0000588}}, Glass{0.2f, {0.09625471, 0.0000453}}));

}  // namespace
}  // namespace wend
