// Whole pictures: reproducible, the same in the mean however they are sampled, and honest about their noise.
#include <tests/support/block_means.h>
#include <tests/support/scenes.h>

#include <wend/stats/significance.h>

#include <gtest/gtest.h>

#include <cmath>
#include <tuple>

namespace wend {
namespace {

constexpr int room_resolution = 24;

/// A foggy room with a small light behind a screen: surfaces and a volume, much indirect light.
SceneDescription foggy_room(bool grid = false) {
    SceneDescription s = test::scene_with_camera({0, 0, -3.5f}, {0, 0, 0}, 40, room_resolution);
    const Box3 room(Vec3(-1), Vec3(1));
    const Rgb absorption(0.05f, 0.1f, 0.15f);
    const Rgb scattering(0.6f, 0.5f, 0.4f);
    const MediumId fog = grid ? test::add_uniform_grid(s, room, absorption, scattering, 0.4f)
                              : test::add_homogeneous(s, absorption, scattering, 0.4f);
    s.camera_medium = vacuum;
    const int white = test::add_diffuse(s, Rgb(0.7f));
    const int red = test::add_diffuse(s, {0.7f, 0.2f, 0.1f});
    const int boundary = test::add_interface(s);
    test::add_parallelogram(s, {-1, -1, -1}, {0, 2, 0}, {2, 0, 0}, boundary, fog);  // open front
    test::add_parallelogram(s, {-1, -1, 1}, {2, 0, 0}, {0, 2, 0}, white);
    test::add_parallelogram(s, {-1, -1, -1}, {0, 0, 2}, {0, 2, 0}, red);
    test::add_parallelogram(s, {1, -1, -1}, {0, 2, 0}, {0, 0, 2}, white);
    test::add_parallelogram(s, {-1, -1, -1}, {2, 0, 0}, {0, 0, 2}, white);
    test::add_parallelogram(s, {-1, 1, -1}, {0, 0, 2}, {2, 0, 0}, white);
    test::add_parallelogram(s, {-0.5f, 0.5f, -0.5f}, {1, 0, 0}, {0, 0, 1}, white);  // the screen under the light
    test::add_sphere(s, {0.4f, -0.6f, 0.2f}, 0.3f, test::add_dielectric(s, 1.5f), vacuum, fog);
    const Vec3 p(-0.3f, 0.9f, -0.3f);
    s.lights.push_back(make_triangle_light(p, p + Vec3(0.6f, 0, 0), p + Vec3(0, 0, 0.6f), true, Rgb(20.0f), true));
    Surface emitter{TriangleMesh{{p, p + Vec3(0.6f, 0, 0), p + Vec3(0, 0, 0.6f)}, {}, {}, {0, 1, 2}}, white};
    emitter.first_light = 0;
    s.world_surfaces.push_back(static_cast<int>(s.surfaces.size()));
    s.surfaces.push_back(std::move(emitter));
    return s;
}

Image render_image(const Scene& scene, const char* preset, int samples, std::uint64_t seed, int threads = 0,
                   RenderStatistics* statistics = nullptr) {
    Film film({room_resolution, room_resolution}, {{0, 0}, {room_resolution, room_resolution}});
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = samples;
    settings.seed = seed;
    settings.threads = threads;
    settings.max_depth = 20;
    const RenderStatistics result = render(scene, film, settings);
    if (statistics) {
        *statistics = result;
    }
    return film.beauty();
}

class Reproducible : public testing::TestWithParam<const char*> {};

TEST_P(Reproducible, TheSamePictureForAnyNumberOfThreads) {
    for (const bool grid : {false, true}) {
        const Scene scene(foggy_room(grid));
        const Image one = render_image(scene, GetParam(), 20, 3, 1);
        for (const int threads : {2, 5}) {
            EXPECT_EQ(render_image(scene, GetParam(), 20, 3, threads).pixels, one.pixels)
                << threads << " threads" << (grid ? ", grid" : "");
        }
        EXPECT_NE(render_image(scene, GetParam(), 20, 4, 2).pixels, one.pixels)
            << "another seed must give another picture";
    }
}

INSTANTIATE_TEST_SUITE_P(Presets, Reproducible,
                         testing::Values("classical", "scatter", "distance", "direction", "full", "roulette",
                                         "splitting", "adaptive"));

class Repeated : public testing::TestWithParam<std::tuple<const char*, int>> {};

TEST_P(Repeated, TheListOfPassesRepeatsARunThatWasStopped) {
    const Scene scene(foggy_room());
    RenderSettings settings;
    settings.preset = parse_preset(std::get<0>(GetParam()));
    settings.seconds = 1e9;
    Film stopped({room_resolution, room_resolution}, {{0, 0}, {room_resolution, room_resolution}});
    int samples = 0;
    const RenderStatistics first = render(scene, stopped, settings, [&](const RenderProgress& progress) {
        samples = progress.samples;
        return samples < std::get<1>(GetParam());
    });
    EXPECT_TRUE(first.interrupted);
    EXPECT_EQ(first.samples, samples) << "no pass begins after the stop";
    settings.passes = first.passes;
    settings.seconds = 0;
    Film repeated({room_resolution, room_resolution}, {{0, 0}, {room_resolution, room_resolution}});
    render(scene, repeated, settings);
    EXPECT_EQ(stopped.beauty().pixels, repeated.beauty().pixels);
}

INSTANTIATE_TEST_SUITE_P(Presets, Repeated,
                         testing::Combine(testing::Values("direction", "full"), testing::Values(3, 10, 40)));

/// The foggy room as classical sampling has it: 192 renders of 128 samples per pixel with the seeds from 100000 on
/// (14 million samples), and the standard errors from their scatter.
const test::BlockReference foggy_room_reference = {{0.41331798, 0.00041678},
                                                   {{0.3766770, 0.0012445},
                                                    {2.4208390, 0.0030332},
                                                    {0.3414534, 0.0011610},
                                                    {0.1304619, 0.0006726},
                                                    {0.1455518, 0.0007474},
                                                    {0.1443459, 0.0008015},
                                                    {0.0473600, 0.0003849},
                                                    {0.0594603, 0.0005031},
                                                    {0.0537126, 0.0004925}}};

struct PresetInFog {
    const char* preset;
    bool grid;
};

void PrintTo(const PresetInFog& comparison, std::ostream* out) {
    *out << comparison.preset << (comparison.grid ? ", grid" : "");
}

class Guided : public testing::TestWithParam<PresetInFog> {};

TEST_P(Guided, GivesTheSamePictureAsClassicalSampling) {
    RenderSettings settings;
    settings.preset = parse_preset(GetParam().preset);
    settings.samples = 128;  // more than the samples after which those of the beginning are dropped
    settings.max_depth = 20;
    settings.seed = 2000;
    const test::BlockReference& reference = foggy_room_reference;
    const test::BlockMeans means = test::render_until(Scene(foggy_room(GetParam().grid)), settings,
                                                      {room_resolution, room_resolution}, 8, reference, 0.0032, 64);
    const double error = means.error(reference);
    EXPECT_LT(3 * error, 0.01 * reference.whole.mean) << "too few samples to see a bias of 1 %";
    EXPECT_TRUE(agrees(means.whole().mean() - reference.whole.mean, error, 0, 3.5))
        << means.whole().mean() << " +- " << error << ", not " << reference.whole.mean;
    EXPECT_GT(means.p_value(reference), 1e-4);
    EXPECT_LT(means.p_value(reference, 1.03), 1e-4) << "the test could not see a bias of 3 %";
}

std::vector<PresetInFog> comparisons() {
    std::vector<PresetInFog> all;
    for (const char* preset :
         {"scatter", "distance", "distance+direction", "direction", "full", "roulette+splitting"}) {
        all.push_back({preset, false});
    }
    // Flights through grids are classical whatever guides them: of the presets that guide flights one is enough.
    for (const char* preset : {"distance", "direction", "full", "roulette+splitting"}) {
        all.push_back({preset, true});
    }
    return all;
}

INSTANTIATE_TEST_SUITE_P(SlowPresets, Guided, testing::ValuesIn(comparisons()));

TEST(Render, CountsItsWork) {
    const Scene scene(foggy_room());
    RenderStatistics statistics;
    render_image(scene, "direction", 5, 1, 0, &statistics);
    EXPECT_EQ(statistics.samples, 5);
    EXPECT_EQ(statistics.counts.paths, 5u * room_resolution * room_resolution);
    EXPECT_GT(statistics.counts.segments, statistics.counts.paths);
    EXPECT_EQ(statistics.counts.rejected, 0u);
    EXPECT_GT(statistics.field_bytes, 0u);
    EXPECT_EQ(statistics.passes, (std::vector<int>{1, 2, 2}));
}

TEST(Render, FollowsAGivenFieldWithoutTeachingItWhereToldSo) {
    const Scene scene(foggy_room());
    RenderStatistics taught;
    render_image(scene, "full", 15, 1, 0, &taught);
    RenderSettings settings;
    settings.preset = parse_preset("full");
    settings.samples = 15;
    settings.seed = 2;
    settings.fields = taught.fields;
    const auto fluence_after = [&](int training_samples) {
        settings.training_samples = training_samples;
        int told = 0;
        settings.on_records = [&](std::span<const guide::PathRecords>) { ++told; };
        Film film({room_resolution, room_resolution}, {{0, 0}, {room_resolution, room_resolution}});
        const RenderStatistics statistics = render(scene, film, settings);
        EXPECT_EQ(told > 0, training_samples > 0);
        return statistics.fields->volume.find(Vec3(0, 0, 0))->fluence();
    };
    const float given = taught.fields->volume.find(Vec3(0, 0, 0))->fluence();
    EXPECT_GT(given, 0.0f);
    EXPECT_EQ(fluence_after(0), given);
    EXPECT_NE(fluence_after(15), given);
}

TEST(Render, TellsNoMoreThanItsBudget) {
    const Scene scene(foggy_room());
    constexpr double most = 3000;
    struct Told {
        std::vector<double> records;
        std::vector<Vec3> places;
        Image picture;
    };
    const auto told_by = [&](int threads, double budget) {
        Told told;
        RenderSettings settings;
        settings.preset = parse_preset("full");
        settings.samples = 31;
        settings.seed = 1;
        settings.threads = threads;
        settings.most_records = budget;
        settings.on_records = [&](std::span<const guide::PathRecords> parts) {
            double count = 0;
            for (const guide::PathRecords& part : parts) {
                count += static_cast<double>(part.size());
                for (const guide::ScatterRecord& record : part.volume_scattered()) {
                    told.places.push_back(record.position);
                }
            }
            told.records.push_back(count);
        };
        Film film({room_resolution, room_resolution}, {{0, 0}, {room_resolution, room_resolution}});
        render(scene, film, settings);
        told.picture = film.beauty();
        return told;
    };
    const Told told = told_by(1, most), again = told_by(2, most);
    EXPECT_EQ(told.places, again.places);
    EXPECT_EQ(told.picture.pixels, again.picture.pixels);
    // The first pass guesses; from then on it is known how much a walk tells.
    ASSERT_EQ(told.records.size(), 5u);
    EXPECT_GT(told.records[0], 0);
    for (std::size_t pass = 0; pass < told.records.size(); ++pass) {
        EXPECT_LT(told.records[pass], 1.2 * most);
    }
    EXPECT_GT(told.records.back(), 0.8 * most);
    EXPECT_GT(told_by(1, 1e9).records.back(), 2 * most) << "nothing had to be left out";
}

TEST(Render, StopsBetweenPassesWhenAsked) {
    const Scene scene(foggy_room());
    Film film({room_resolution, room_resolution}, {{0, 0}, {room_resolution, room_resolution}});
    RenderSettings settings;
    settings.samples = 1000;
    int calls = 0;
    const RenderStatistics statistics =
        render(scene, film, settings, [&](const RenderProgress&) { return ++calls < 3; });
    EXPECT_TRUE(statistics.interrupted);
    EXPECT_EQ(statistics.passes.size(), 3u);
    EXPECT_EQ(film.picture().layers[3].values[0], static_cast<float>(statistics.samples));
}

TEST(Preset, NamesAreParsedAndUnknownOnesListed) {
    EXPECT_TRUE(parse_preset("classical").is_classical());
    EXPECT_TRUE(parse_preset("direction").direction);
    EXPECT_EQ(to_string(parse_preset("direction")), "direction");
    EXPECT_EQ(to_string(parse_preset("splitting+direction")), "direction+splitting");
    EXPECT_EQ(to_string(parse_preset("scatter+distance")), "distance");
    EXPECT_EQ(parse_preset("distance"), parse_preset("scatter+distance"));
    EXPECT_EQ(to_string(parse_preset("full")), "full");
    // All decisions, but everywhere.
    const Preset everywhere = parse_preset("distance+direction+roulette+splitting");
    EXPECT_FALSE(everywhere.where_it_pays);
    EXPECT_EQ(to_string(everywhere), "distance+direction+roulette+splitting");
    // Which samples a pixel gets does not make its paths guided.
    EXPECT_TRUE(parse_preset("adaptive").is_classical());
    EXPECT_TRUE(parse_preset("full").adaptive);
    EXPECT_FALSE(parse_preset("full+uniform").adaptive);
    EXPECT_EQ(to_string(parse_preset("full+uniform")), "full+uniform");
    try {
        parse_preset("directions");
        FAIL();
    } catch (const std::exception& e) {
        EXPECT_NE(std::string(e.what()).find("direction"), std::string::npos);
    }
}

TEST(Preset, TheAblationHasEachDecisionAloneAndEachLeftOut) {
    std::vector<std::string> names, roles;
    for (const Preset& preset : ablation_presets()) {
        names.push_back(to_string(preset));
        roles.push_back(ablation_role(preset));
        EXPECT_EQ(parse_preset(names.back()), preset);
    }
    EXPECT_EQ(names, (std::vector<std::string>{
                         "classical", "scatter", "distance", "direction", "roulette", "splitting", "adaptive", "full",
                         "direction+roulette+splitting+adaptive", "scatter+direction+roulette+splitting+adaptive",
                         "distance+roulette+splitting+adaptive", "distance+direction+splitting+adaptive",
                         "distance+direction+roulette+adaptive", "distance+direction+roulette+splitting"}));
    EXPECT_EQ(roles, (std::vector<std::string>{"", "only scatter", "only distance", "only direction", "only roulette",
                                               "only splitting", "only adaptive", "", "no scatter", "no distance",
                                               "no direction", "no roulette", "no splitting", "no adaptive"}));
    EXPECT_EQ(ablation_role(parse_preset("distance+direction")), "");
}

}  // namespace
}  // namespace wend
