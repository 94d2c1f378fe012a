// Choices of lights that were learned: their probabilities, what they learn, and that pictures stay the same.
#include <tests/support/repeated_renders.h>
#include <tests/support/scenes.h>

#include <wend/light/light_selection.h>
#include <wend/stats/chi_square.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

namespace wend {
namespace {

constexpr int resolution = 16;
constexpr int hidden = 1, first_plain = 0, sky = 4;

/// A floor and a wall under four lamps and a dim sky. The strongest lamp stands over a plate that hides it
/// from nearly everything.
SceneDescription lamps() {
    SceneDescription s = test::scene_with_camera({0, 1, -4}, {0, 0.3f, 0}, 18, resolution);
    const int grey = test::add_diffuse(s, Rgb(0.5f));
    test::add_parallelogram(s, {-2, 0, -2}, {0, 0, 4}, {4, 0, 0}, grey);
    test::add_parallelogram(s, {-2, 0, 1.5f}, {4, 0, 0}, {0, 1.5f, 0}, grey);
    test::add_parallelogram(s, {-1.2f, 1.9f, -1.2f}, {2.4f, 0, 0}, {0, 0, 2.4f}, grey);
    test::add_lamp(s, {-1.5f, 1.2f, 0.5f}, 0.3f, {8, 4, 2}, grey);
    test::add_lamp(s, {-0.3f, 2, -0.3f}, 0.6f, Rgb(60.0f), grey);
    test::add_lamp(s, {1.2f, 1.5f, 0}, 0.3f, {2, 4, 8}, grey);
    test::add_lamp(s, {1.4f, 1, -1}, 0.2f, Rgb(5.0f), grey);
    test::add_environment(s, Rgb(0.05f));
    return s;
}

/// What some thousand connections might have brought around these receivers.
std::vector<LightRecord> random_records(const LightSelection& choices, std::span<const LightReceiver> receivers,
                                        int lights) {
    std::vector<LightRecord> records;
    Pcg32 random(3);
    for (const LightReceiver& receiver : receivers) {
        for (int i = 0; i < 400; ++i) {
            const int light = static_cast<int>(random.uniform() * static_cast<float>(lights));
            const float brought = light == 2 ? 0.0f : static_cast<float>(light + 1) * random.uniform();
            records.push_back(choices.record(receiver, light, brought));
        }
    }
    return records;
}

std::vector<LightReceiver> receivers() {
    return {{{0.5f, 0.01f, 0}, {0, 1, 0}}, {{-0.5f, 0.3f, 1.49f}, {0, 0, -1}}, {{0.2f, 1, -0.5f}, {0, 0, 0}}};
}

TEST(LightSelection, FrequenciesFitTheProbabilities) {
    const Scene scene(lamps());
    const int lights = static_cast<int>(scene.lights().size());
    for (const bool learned : {false, true}) {
        LightSelection choices(scene);
        ASSERT_TRUE(choices.learns());
        if (learned) {
            choices.add(random_records(choices, receivers(), lights));
            choices.learn(0);
        }
        for (const LightReceiver& receiver : receivers()) {
            constexpr int samples = 50000;
            std::vector<double> expected;
            for (int i = 0; i < lights; ++i) {
                expected.push_back(samples * static_cast<double>(choices.probability(receiver, i)));
            }
            EXPECT_NEAR(std::accumulate(expected.begin(), expected.end(), 0.0) / samples, 1, 1e-5);
            std::vector<std::uint64_t> observed(expected.size());
            Pcg32 random(1);
            for (int i = 0; i < samples; ++i) {
                const ChosenLight chosen = choices.sample(receiver, random.uniform());
                ASSERT_GE(chosen.index, 0);
                EXPECT_NEAR(chosen.probability, choices.probability(receiver, chosen.index), 1e-6);
                ++observed[static_cast<std::size_t>(chosen.index)];
            }
            EXPECT_GE(chi_square_test(observed, expected).p_value, 1e-4);
            std::rotate(expected.begin(), expected.begin() + 1, expected.end());
            EXPECT_LT(chi_square_test(observed, expected).p_value, 1e-6);
        }
    }
}

TEST(LightSelection, TheEndsOfTheUnitIntervalAreLights) {
    const Scene scene(lamps());
    LightSelection choices(scene);
    choices.add(random_records(choices, receivers(), sky));
    choices.learn(0);  // nothing of the last light
    for (const LightReceiver& receiver : receivers()) {
        for (const float u : {0.0f, 0.25f, std::nextafter(1.0f, 0.0f)}) {
            const ChosenLight chosen = choices.sample(receiver, u);
            EXPECT_GE(chosen.index, 0);
            EXPECT_GT(chosen.probability, 0);
        }
    }
}

TEST(LightSelection, FollowWhatWasBrought) {
    const Scene scene(lamps());
    LightSelection choices(scene);
    const LightReceiver here = receivers().front();
    const float before = choices.probability(here, hidden);
    std::vector<LightRecord> records;
    for (int i = 0; i < 1000; ++i) {
        records.push_back(choices.record(here, hidden, 0));
        records.push_back(choices.record(here, first_plain, 2));
        records.push_back(choices.record(here, sky, 1));
        records.push_back(choices.record(here, sky, NAN));
    }
    choices.add(records);
    choices.learn(0);
    EXPECT_LT(choices.probability(here, hidden), 0.3f * before);
    EXPECT_GT(choices.probability(here, hidden), 0) << "what was never seen may yet be";
    EXPECT_NEAR(choices.probability(here, first_plain) / 0.75f, 2.0f / 3, 0.2f);
    // Elsewhere, and on the other side of a surface, nothing is known.
    const LightReceiver below{here.position, -here.normal};
    EXPECT_EQ(choices.probability(below, hidden), LightSelection(scene).probability(below, hidden));
}

TEST(LightSelection, AreLeftToTheSceneWhereThereAreTooManyOrOne) {
    for (const int lights : {1, 300}) {
        SceneDescription s;
        for (int i = 0; i < lights; ++i) {
            s.lights.push_back(PointLight{{static_cast<float>(i), 1, 0}, Rgb(1.0f)});
        }
        EXPECT_FALSE(LightSelection(Scene(std::move(s))).learns()) << lights;
    }
}

/// An open floor under so many suns, of which the first is strongest, by that many samples.
Image sunny_floor(int lights, int samples, const char* sampling, SamplerKind sampler = SamplerKind::sobol) {
    constexpr int side = 32;  // smaller pictures are guided from the start
    SceneDescription s = test::scene_with_camera({0, 2, 0}, {0, 0, 0.5f}, 40, side);
    test::add_parallelogram(s, {-9, 0, -9}, {0, 0, 18}, {18, 0, 0}, test::add_diffuse(s, Rgb(0.5f)));
    for (int i = 0; i < lights; ++i) {
        const Vec3 towards = normalize(Vec3(0.1f * static_cast<float>(i), 1, 0));
        s.lights.push_back(DistantLight{towards, Rgb(i == 0 ? 4.0f : 1.0f)});
    }
    RenderSettings settings;
    settings.preset = parse_preset(sampling);
    settings.samples = samples;
    settings.sampler = sampler;
    Film film({side, side}, {{0, 0}, {side, side}});
    render(Scene(std::move(s)), film, settings);
    return film.beauty();
}

double mean_square_error(const Image& picture, const Image& expected) {
    double sum = 0;
    for (std::size_t i = 0; i < picture.pixels.size(); ++i) {
        sum += std::pow(luminance(picture.pixels[i] - expected.pixels[i]), 2);
    }
    return sum / static_cast<double>(picture.pixels.size());
}

TEST(LightSelection, ShortRendersTakeFewLightsInTurn) {
    const auto is_as_classical = [](int lights, int samples, SamplerKind sampler) {
        return sunny_floor(lights, samples, "full", sampler).pixels ==
               sunny_floor(lights, samples, "classical", sampler).pixels;
    };
    EXPECT_TRUE(is_as_classical(2, 4, SamplerKind::sobol));
    // What is learned pays where there are too many, where they come by chance, and in longer renders.
    EXPECT_FALSE(is_as_classical(6, 4, SamplerKind::sobol));
    EXPECT_FALSE(is_as_classical(2, 4, SamplerKind::independent));
    EXPECT_FALSE(is_as_classical(2, 16, SamplerKind::sobol));
    const Image expected = sunny_floor(2, 1024, "classical");
    EXPECT_LT(mean_square_error(sunny_floor(2, 4, "full"), expected),
              0.1 * mean_square_error(sunny_floor(2, 4, "direction"), expected));
}

// Two ways, sixteen renders or more of 16 x 16 pixels by 512 samples each.
TEST(SlowLightSelection, GiveTheSamePictureWithLessNoise) {
    const Scene scene(lamps());
    RenderSettings settings;
    settings.samples = 512;
    settings.max_depth = 20;
    settings.seed = 1000;
    const auto expected = test::kept_means("light_selection", [&] {
        const test::RepeatedRenders classical(scene, settings, resolution, {32, 32});
        return std::vector{test::KnownMean{classical.mean.mean(), classical.mean.standard_error()}};
    });
    // Its noise alone: its mean is known.
    const test::RepeatedRenders classical(scene, settings, resolution, {8, 8});
    settings.seed = 2000;
    for (const char* sampling : {"direction", "full"}) {
        SCOPED_TRACE(sampling);
        settings.preset = parse_preset(sampling);
        const test::RepeatedRenders guided(scene, settings, resolution);
        test::expect_mean(guided, expected.front());
        EXPECT_LT(guided.noise, 0.85 * classical.noise);
    }
}

}  // namespace
}  // namespace wend
