// A render that is divided into steps, saved and resumed gives the picture of one that never stopped, bit for bit.
#include <tests/support/film_bytes.h>
#include <tests/support/scenes.h>
#include <tests/support/thread_ranks.h>

#include <wend/core/archive.h>
#include <wend/core/error.h>
#include <wend/guide/field.h>
#include <wend/render/render.h>

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <thread>
#include <vector>

namespace wend {
namespace {

using test::bytes_of;

// Large enough for all kinds of walks to be tried.
constexpr int resumed_resolution = 40;

/// Fog around a ball of smooth glass, a dense block and two lamps: all that learns has something to learn.
SceneDescription table_top() {
    SceneDescription s = test::scene_with_camera({0, 1.2f, -5}, {0, -0.2f, 0}, 32, resumed_resolution);
    const MediumId fog = test::add_homogeneous(s, Rgb(0.01f), Rgb(0.1f), 0.4f);
    const MediumId wax = test::add_homogeneous(s, {0.2f, 0.5f, 1.5f}, {15, 14, 12}, 0.3f);
    test::add_box(s, Box3(Vec3(-2, -1, -1.5f), Vec3(2, 1.5f, 1.5f)), test::add_interface(s), fog);
    test::add_box(s, Box3(Vec3(-1.1f, -0.9f, -0.5f), Vec3(-0.1f, 0.6f, 0.5f)), test::add_interface(s), wax, fog);
    test::add_sphere(s, {0.9f, -0.2f, 0}, 0.6f, test::add_dielectric(s, 1.5f), vacuum, fog);
    const int grey = test::add_diffuse(s, Rgb(0.5f));
    test::add_parallelogram(s, {-4, -1.001f, -4}, {0, 0, 8}, {8, 0, 0}, grey);
    test::add_lamp(s, {-2, 2, -2}, 1, {9, 4, 2}, grey);
    test::add_lamp(s, {1, 2.5f, 0}, 0.5f, {2, 8, 9}, grey);
    return s;
}

/// With all that a film may hold.
Film full_film() {
    return Film({resumed_resolution, resumed_resolution}, {{0, 0}, {resumed_resolution, resumed_resolution}},
                {{"direct", "indirect"}, true, true});
}

RenderSettings resumed_settings(const char* preset, int threads) {
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.subsurface = parse_subsurface("auto");
    settings.samples = 31;
    settings.training_samples = 15;
    settings.seed = 5;
    settings.threads = threads;
    settings.max_depth = 30;
    settings.parts.count = 2;
    settings.parts.by_path[static_cast<std::size_t>(PathPart::direct)] = 0;
    settings.parts.by_path[static_cast<std::size_t>(PathPart::indirect)] = 1;
    settings.parts.is_at_infinity.assign(16, false);  // none of the lamps
    return settings;
}

std::string saved(const Render& render) {
    ArchiveWriter bytes;
    render.save(bytes);
    return bytes.take();
}

std::string uninterrupted(const Scene& scene, const RenderSettings& settings) {
    Film film = full_film();
    render(scene, film, settings);
    return bytes_of(film);
}

/// What one thread makes in one go, which many tests compare with.
const std::string& uninterrupted(const char* preset) {
    static std::map<std::string, std::string> known;
    std::string& film = known[preset];
    if (film.empty()) {
        film = uninterrupted(Scene(table_top()), resumed_settings(preset, 1));
    }
    return film;
}

class Resumed : public testing::TestWithParam<const char*> {};

TEST_P(Resumed, IsTheRenderThatNeverStopped) {
    const Scene scene(table_top());
    const std::string& expected = uninterrupted(GetParam());
    constexpr double step_seconds = 0.005;
    int resumed = 0, within = 0;
    for (const int threads : {1, 2, 5}) {
        // Ever more of them, so that a slow machine stops hardly more often than a fast one.
        int steps = 0, next_stop = 12;
        auto film = std::make_unique<Film>(full_film());
        auto render = std::make_unique<Render>(scene, *film, resumed_settings(GetParam(), threads));
        while (render->step(step_seconds)) {
            if (++steps == next_stop) {
                next_stop += next_stop / 4;
                within += render->is_within_pass() ? 1 : 0;
                const std::string state = saved(*render);
                film = std::make_unique<Film>(full_film());
                render = std::make_unique<Render>(scene, *film, resumed_settings(GetParam(), 1 + resumed++ % 3));
                ArchiveReader bytes(state);
                render->restore(bytes);
                EXPECT_EQ(saved(*render).size(), state.size());
            }
        }
        EXPECT_EQ(render->result().samples, 31);
        EXPECT_TRUE(bytes_of(*film) == expected) << threads << " threads, resumed " << resumed << " times";
    }
    EXPECT_GT(resumed, 1) << "the test is of no use";
    EXPECT_GT(within, 0) << "nor where passes are never cut";
}

TEST_P(Resumed, WalksThatWereDroppedAreWalkedAgain) {
    const Scene scene(table_top());
    const std::string& expected = uninterrupted(GetParam());
    std::atomic<bool> stop = false;
    RenderSettings settings = resumed_settings(GetParam(), 2);
    settings.stop = &stop;
    Film film = full_film();
    Render render(scene, film, settings);
    int stops = 0;
    for (bool goes_on = true; goes_on;) {
        stop = false;
        std::thread stopper([&] {
            std::this_thread::sleep_for(std::chrono::milliseconds(20));
            stop = true;
        });
        goes_on = render.step();
        stopper.join();
        ++stops;
    }
    EXPECT_GT(stops, 5);
    EXPECT_TRUE(bytes_of(film) == expected);
}

INSTANTIATE_TEST_SUITE_P(Presets, Resumed,
                         testing::Values("classical", "direction", "full", "distance+direction+roulette+splitting"));

/// What each of so many ranks has in the end; `work` is done by each, with its render and its film.
template <class Work>
std::vector<std::string> by_ranks(int count, const Scene& scene, const RenderSettings& settings, const Work& work) {
    std::vector<std::string> films(static_cast<std::size_t>(count));
    test::by_thread_ranks(count, [&](Ranks& ranks) {
        RenderSettings own = settings;
        own.ranks = &ranks;
        Film film = full_film();
        Render render(scene, film, own);
        work(render, ranks);
        films[static_cast<std::size_t>(ranks.rank())] = bytes_of(film);
    });
    return films;
}

TEST_P(Resumed, AnyNumberOfRanksHasTheSameFilm) {
    const Scene scene(table_top());
    const std::string& expected = uninterrupted(GetParam());
    for (const int count : {2, 3, 5}) {
        const auto films = by_ranks(count, scene, resumed_settings(GetParam(), 1), [](Render& render, const Ranks&) {
            while (render.step(0.02)) {
            }
        });
        for (const std::string& film : films) {
            EXPECT_TRUE(film == expected) << count << " ranks";
        }
    }
}

TEST_P(Resumed, RanksStopTogetherAndAnyNumberGoesOn) {
    const Scene scene(table_top());
    const std::string& expected = uninterrupted(GetParam());
    std::string state;
    std::atomic<bool> stop = false;
    RenderSettings settings = resumed_settings(GetParam(), 1);
    settings.stop = &stop;
    by_ranks(3, scene, settings, [&](Render& render, const Ranks& ranks) {
        for (int step = 0; !render.is_stopped() && render.step(0.02); ++step) {
            if (ranks.rank() == 1 && step == 10) {
                stop = true;
            }
        }
        if (ranks.rank() == 0) {
            state = saved(render);
        }
    });
    for (const int count : {1, 2}) {
        const auto films = by_ranks(count, scene, resumed_settings(GetParam(), 1), [&](Render& render, const Ranks&) {
            ArchiveReader bytes(state);
            render.restore(bytes);
            while (render.step(0.05)) {
            }
        });
        EXPECT_TRUE(films.front() == expected) << count << " ranks";
    }
}

TEST(SlowRanksOfARender, LearnTheSameAndShowAllRecordsToWhoAsks) {
    const Scene scene(table_top());
    RenderSettings settings = resumed_settings("full", 1);
    settings.keeps_fields = true;
    // Notes of techniques inside dense media have bytes between their members that mean nothing.
    settings.subsurface = parse_subsurface("classical");
    std::size_t expected_records = 0;
    const auto count_into = [](std::size_t& sum) {
        return [&sum](std::span<const guide::PathRecords> records) {
            for (const guide::PathRecords& of_tile : records) {
                sum += of_tile.size();
            }
        };
    };
    settings.on_records = count_into(expected_records);
    Film alone = full_film();
    const RenderStatistics expected = render(scene, alone, settings);
    std::vector<guide::Fields> learned(3, *expected.fields);
    std::size_t records = 0;
    test::by_thread_ranks(3, [&](Ranks& ranks) {
        RenderSettings own = settings;
        own.ranks = &ranks;
        own.on_records = {};
        if (ranks.rank() == 1) {
            own.on_records = count_into(records);
        }
        Film film = full_film();
        const RenderStatistics statistics = render(scene, film, own);
        learned[static_cast<std::size_t>(ranks.rank())] = *statistics.fields;
    });
    for (const guide::Fields& one : learned) {
        EXPECT_TRUE(guide::to_bytes(one.surface) == guide::to_bytes(expected.fields->surface));
        EXPECT_TRUE(guide::to_bytes(one.volume) == guide::to_bytes(expected.fields->volume));
        EXPECT_TRUE(one.notes == expected.fields->notes);
    }
    EXPECT_GT(expected_records, 1000u);
    EXPECT_EQ(records, expected_records);
}

TEST(Ranks, GetSharesOfLikeWork) {
    const std::vector<std::uint64_t> work = {9, 1, 1, 1, 1, 5, 4, 0, 0};
    const std::vector<int> shares = shares_of_ranks(work, 2);
    std::uint64_t load[2] = {0, 0};
    for (std::size_t i = 0; i < work.size(); ++i) {
        load[shares[i]] += work[i];
    }
    EXPECT_EQ(load[0], 11u);
    EXPECT_EQ(load[1], 11u);
    EXPECT_EQ(shares_of_ranks({0, 0, 0}, 3).size(), 3u);
    EXPECT_EQ(shares_of_ranks({}, 3).size(), 0u);
}

TEST(Render, ForeignBytesAreRefused) {
    const Scene scene(table_top());
    Film film = full_film();
    Render render(scene, film, resumed_settings("full", 1));
    for (int pass = 0; pass < 4; ++pass) {
        render.step();
    }
    const std::string state = saved(render);
    const auto restored = [&](const std::string& bytes) {
        Film other = full_film();
        Render again(scene, other, resumed_settings("full", 1));
        ArchiveReader reader(bytes);
        again.restore(reader);
    };
    EXPECT_NO_THROW(restored(state));
    EXPECT_THROW(restored(state + "x"), InputError);
    for (std::size_t size = 0; size < state.size(); size += 1 + state.size() / 12) {
        EXPECT_THROW(restored(state.substr(0, size)), InputError) << size;
    }
    Film larger({resumed_resolution + 1, resumed_resolution}, {{0, 0}, {resumed_resolution + 1, resumed_resolution}});
    Render other(scene, larger, resumed_settings("full", 1));
    ArchiveReader reader(state);
    EXPECT_THROW(other.restore(reader), InputError);
}

TEST(Render, PassesToBeRepeatedAreThoseThatItHasHad) {
    const Scene scene(table_top());
    const RenderSettings settings = resumed_settings("classical", 1);
    Film film = full_film();
    Render render(scene, film, settings);
    for (int pass = 0; pass < 3; ++pass) {
        render.step();
    }
    const auto go_on = [&](const std::string& state, std::vector<int> passes) {
        RenderSettings repeated = settings;
        repeated.passes = std::move(passes);
        Film other = full_film();
        Render again(scene, other, repeated);
        ArchiveReader reader(state);
        again.restore(reader);
        while (again.step()) {
        }
        return again.statistics().passes;
    };
    const std::string state = saved(render);
    EXPECT_EQ(go_on(state, {1, 2, 4, 3}), (std::vector<int>{1, 2, 4, 3}));
    EXPECT_EQ(go_on(state, {1, 2, 4}), (std::vector<int>{1, 2, 4}));
    for (const std::vector<int>& others : {std::vector<int>{1, 2}, {1, 2, 5}, {7, 2, 4, 3}}) {
        EXPECT_THROW(go_on(state, others), InputError) << others.back();
    }
    render.step(0);
    ASSERT_TRUE(render.is_within_pass());
    EXPECT_THROW(go_on(saved(render), {1, 2, 4, 3}), InputError) << "a pass of eight has been begun";
    EXPECT_EQ(go_on(saved(render), {1, 2, 4, 8}), (std::vector<int>{1, 2, 4, 8}));
}

TEST(Render, KeepsToItsTime) {
    const Scene scene(table_top());
    RenderSettings settings = resumed_settings("full", 1);
    settings.samples = 1;
    Film first = full_film();
    // However fast the machine is.
    settings.seconds = 10 * render(scene, first, settings).seconds;
    Film film = full_film();
    Render render(scene, film, settings);
    int steps = 0;
    while (render.step(0.02)) {
        ++steps;
    }
    EXPECT_GT(steps, 0);
    const RenderStatistics statistics = render.result();
    EXPECT_GT(statistics.samples, 0);
    EXPECT_NEAR(render.progress().fraction, 1, 0.2);
}

RenderSettings settings_by_noise(const char* preset) {
    RenderSettings settings = resumed_settings(preset, 2);
    settings.samples = 1000;
    settings.noise = 0.5;
    return settings;
}

TEST(EndedByNoiseSlow, OnceEverySquareIsQuietEnough) {
    const Scene scene(table_top());
    int samples[2] = {0, 0};
    for (const bool is_adaptive : {false, true}) {
        Film film = full_film();
        const RenderSettings settings = settings_by_noise(is_adaptive ? "full" : "full+uniform");
        Render render(scene, film, settings);
        double before = 1, fraction = 0;
        while (render.step()) {
            before = render.progress().relative_noise;
            fraction = render.progress().fraction;
        }
        EXPECT_LE(render.progress().relative_noise, settings.noise);
        EXPECT_LE(film.relative_noise(), settings.noise);
        samples[is_adaptive ? 1 : 0] = render.result().samples;
        EXPECT_GT(render.statistics().samples, 15);
        EXPECT_LT(render.statistics().samples, 1000);
        EXPECT_FALSE(render.statistics().interrupted);
        EXPECT_GT(before, settings.noise) << "no pass earlier";
        EXPECT_LT(fraction, 1);
        EXPECT_GT(fraction, 0.3) << "the end is seen to come";
        EXPECT_EQ(render.progress().fraction, 1);
    }
    EXPECT_LT(samples[1], samples[0]) << "squares that are done leave the rest to others";
}

TEST(EndedByNoiseSlow, EvenIfItWasNotAskedForBefore) {
    const Scene scene(table_top());
    RenderSettings settings = settings_by_noise("full");
    settings.noise = 0;
    settings.samples = 15;
    Film film = full_film();
    Render render(scene, film, settings);
    while (render.step()) {
    }
    const std::string state = saved(render);
    ArchiveReader bytes(state);
    const RenderSettings quieter = settings_by_noise("full");
    Film other = full_film();
    Render again(scene, other, quieter);
    again.restore(bytes);
    EXPECT_GT(again.progress().relative_noise, quieter.noise);
    EXPECT_LT(again.progress().fraction, 1);
    while (again.step()) {
    }
    EXPECT_GT(again.statistics().samples, 15);
    EXPECT_LE(other.relative_noise(), quieter.noise);
}

TEST(EndedByNoiseSlow, IsTheSameInOneGoResumedAndByRanks) {
    const Scene scene(table_top());
    const RenderSettings settings = settings_by_noise("full");
    const std::string expected = uninterrupted(scene, settings);
    auto film = std::make_unique<Film>(full_film());
    auto render = std::make_unique<Render>(scene, *film, settings);
    int steps = 0, resumed = 0;
    while (render->step(0.01)) {
        if (++steps % 8 == 0) {
            const std::string state = saved(*render);
            film = std::make_unique<Film>(full_film());
            render = std::make_unique<Render>(scene, *film, settings);
            ArchiveReader bytes(state);
            render->restore(bytes);
            ++resumed;
        }
    }
    EXPECT_GT(resumed, 1) << "the test is of no use";
    EXPECT_TRUE(bytes_of(*film) == expected);
    for (const std::string& of_rank : by_ranks(3, scene, settings, [](Render&one, const Ranks&) {
             while (one.step(0.02)) {
             }
         })) {
        EXPECT_TRUE(of_rank == expected);
    }
}

}  // namespace
}  // namespace wend
