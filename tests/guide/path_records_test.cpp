#include <wend/core/random.h>
#include <wend/guide/fit.h>
#include <wend/guide/path_log.h>
#include <wend/guide/path_records.h>
#include <wend/stats/moments.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <tuple>

namespace wend::guide {
namespace {

using Path = std::vector<PathVertex>;

Rgb random_rgb(Pcg32& random) {
    const float r = random.uniform(), g = random.uniform();
    return {r, g, random.uniform()};
}

/// The vertices' order is all that is special: any parent that comes before.
Path random_tree(std::size_t size, bool chain, std::uint64_t seed) {
    Pcg32 random(seed);
    Path path(size);
    for (std::size_t i = 0; i < size; ++i) {
        PathVertex& v = path[i];
        v.position = Vec3(random.uniform(), 0, 0);
        v.direction = Vec3(0, 0, 1);
        v.density = 0.5f + random.uniform();
        v.distance = 0.1f + random.uniform();
        v.arrival = random_rgb(random);
        v.scattering = random_rgb(random) * 1.5f;
        v.gathered = random.uniform() < 0.3f ? random_rgb(random) : Rgb();
        v.in_volume = random.uniform() < 0.5f;
        const auto before = static_cast<std::int32_t>(i) - 1;
        v.parent =
            chain || i == 0 ? before : static_cast<std::int32_t>(random.uniform() * static_cast<float>(i + 1)) - 1;
    }
    return path;
}

/// By definition: what every vertex j found, times all weights on the way from i to j, found by climbing from j.
std::vector<Rgb> by_definition(const Path& path) {
    std::vector<Rgb> incident(path.size());
    for (std::size_t j = 0; j < path.size(); ++j) {
        Rgb share = path[j].gathered;
        auto i = static_cast<std::int32_t>(j);
        while (i != PathVertex::root) {
            const PathVertex& v = path[static_cast<std::size_t>(i)];
            incident[static_cast<std::size_t>(i)] += share;
            share *= v.arrival * v.scattering;
            i = v.parent;
        }
    }
    return incident;
}

bool nearly_equal(const Rgb& a, const Rgb& b) {
    for (int c = 0; c < 3; ++c) {
        if (std::abs(a[c] - b[c]) > 1e-5f * (a[c] + b[c]) + 1e-30f) {
            return false;
        }
    }
    return true;
}

TEST(PathLog, TakesWhatADecisionDrew) {
    struct Drawn {
        Vec3 direction{0, 1, 0};
        float density = 0.5f, classical_density = 0.25f, guided_density = 0.75f;
        Rgb weight() const { return {1, 0.5f, 2}; }
    };
    PathLog log, by_hand;
    log.scatter(Vec3(1, 2, 3), Drawn(), true);
    by_hand.scatter(Vec3(1, 2, 3), Vec3(0, 1, 0), 0.5f, Rgb(1, 0.5f, 2), true, 0.25f, 0.75f);
    const PathVertex &a = log.vertices()[0], &b = by_hand.vertices()[0];
    EXPECT_EQ(a.position, b.position);
    EXPECT_EQ(a.direction, b.direction);
    EXPECT_EQ(a.scattering, b.scattering);
    EXPECT_EQ(std::tuple(a.density, a.classical_density, a.guided_density, a.in_volume),
              std::tuple(b.density, b.classical_density, b.guided_density, b.in_volume));
}

TEST(PathRecords, MatchAPathMadeByHand) {
    // A surface, a collision in fog, and a lamp behind it that is also connected to.
    PathLog log;
    log.start();
    log.gather(Rgb(100));  // seen by the camera itself: no vertex's business
    log.scatter(Vec3(0, 0, 0), Vec3(0, 0, 1), 0.5f, Rgb(0.8f), false);
    log.meet(2);
    log.weigh(Rgb(0.5f));
    log.gather(Rgb(3));  // the connection made at the collision
    log.scatter(Vec3(0, 0, 2), Vec3(1, 0, 0), 0.25f, Rgb(0.9f), true, 0.1f, 0.4f);
    log.weigh(Rgb(2));  // survived with probability 1/2
    log.meet(4);
    log.gather(Rgb(7, 0, 0));
    log.meet(5);  // later: not what was met first

    PathRecords records;
    records.add(log.vertices());
    ASSERT_EQ(records.surface().size(), 1u);
    ASSERT_EQ(records.volume().size(), 1u);
    EXPECT_FLOAT_EQ(records.volume()[0].radiance, 14.0f / 3);
    EXPECT_FLOAT_EQ(records.volume()[0].distance, 4);
    EXPECT_FLOAT_EQ(records.volume()[0].density, 0.25f);
    EXPECT_FLOAT_EQ(records.volume()[0].classical_density, 0.1f);
    EXPECT_FLOAT_EQ(records.volume()[0].guided_density, 0.4f);
    EXPECT_FLOAT_EQ(records.volume()[0].scattered, 0.9f * 0.25f * 14.0f / 3);
    EXPECT_EQ(records.volume()[0].colour, Rgb(14, 0, 0));
    EXPECT_EQ(records.surface()[0].guided_density, 0);
    EXPECT_FLOAT_EQ(records.surface()[0].radiance, 0.5f * 3 + 0.5f * 0.9f * 14.0f / 3);
    EXPECT_FLOAT_EQ(records.surface()[0].distance, 2);
    EXPECT_EQ(records.surface()[0].position, Vec3(0, 0, 0));
    EXPECT_EQ(records.surface()[0].direction, Vec3(0, 0, 1));
}

TEST(PathRecords, AMediumsOwnLightIsSeenWhereItIs) {
    const auto distance_of_record = [](float behind) {
        PathLog log;
        log.start();
        log.scatter(Vec3(0, 0, 0), Vec3(0, 0, 1), 1, Rgb(1), false);
        log.weigh(Rgb(0.5f));
        log.glow(Rgb(2), 4);  // a flame
        log.meet(20);
        log.gather(Rgb(behind));
        PathRecords records;
        records.add(log.vertices());
        EXPECT_FLOAT_EQ(records.surface()[0].radiance, 1 + behind / 2);
        return records.surface()[0].distance;
    };
    EXPECT_FLOAT_EQ(distance_of_record(0), 4);
    // As bright as the wall behind: the mean of the inverse distances.
    EXPECT_FLOAT_EQ(distance_of_record(2), 2 / (1.0f / 4 + 1.0f / 20));
}

TEST(PathRecords, MatchTheSumsByDefinition) {
    for (std::uint64_t seed = 0; seed < 200; ++seed) {
        const bool chain = seed % 2 == 0;
        const Path path = random_tree(1 + seed, chain, seed);
        std::vector<Rgb> incident;
        const Rgb brought = incident_radiance(path, incident);
        const std::vector<Rgb> expected = by_definition(path);
        Rgb expected_brought;
        for (std::size_t i = 0; i < path.size(); ++i) {
            ASSERT_TRUE(nearly_equal(incident[i], expected[i])) << "seed " << seed << ", vertex " << i;
            if (path[i].parent == PathVertex::root) {
                expected_brought += path[i].arrival * path[i].scattering * expected[i];
            }
        }
        ASSERT_TRUE(nearly_equal(brought, expected_brought));
    }
}

TEST(PathRecords, AWrongFactorIsDetected) {
    // The twin of the test before: a single factor off by a tenth of a percent.
    Path path = random_tree(40, true, 3);
    path[20].gathered = Rgb(0.5f);
    path[19].gathered = Rgb();
    std::vector<Rgb> incident;
    for (int which = 0; which < 3; ++which) {
        Path wrong = path;
        PathVertex& v = wrong[20];
        (which == 0 ? v.arrival : which == 1 ? v.scattering : v.gathered) *= 1.001f;
        incident_radiance(wrong, incident);
        const std::vector<Rgb> expected = by_definition(path);
        bool all = true;
        for (std::size_t i = 0; i < path.size(); ++i) {
            all = all && nearly_equal(incident[i], expected[i]);
        }
        EXPECT_FALSE(all) << which;
    }
}

TEST(PathRecords, ConserveEnergyInAFurnace) {
    // A medium that emits what it absorbs: radiance 1 everywhere and in every direction, so every record must say 1,
    // whether or not the walk was split on the way.
    constexpr float albedo = 0.75f;
    Pcg32 random(5);
    PathLog log;
    for (int walk = 0; walk < 100; ++walk) {
        log.start();
        struct Open {
            PathLog::Branch branch;
            int depth;
        };
        std::vector<Open> open = {{{}, 0}};
        while (!open.empty()) {
            const Open here = open.back();
            open.pop_back();
            const int copies = random.uniform() < 0.2f ? 2 : 1;
            for (int copy = 0; copy < copies; ++copy) {
                log.resume(here.branch);
                log.weigh(Rgb(1.0f / static_cast<float>(copies)));
                log.scatter(Vec3(0, 0, 0), Vec3(0, 0, 1), inv_4pi, Rgb(1.0f), true);
                log.meet(1);
                if (here.depth == 8) {
                    log.gather(Rgb(1.0f));  // a wall as bright as the medium
                    continue;
                }
                log.gather(Rgb(1 - albedo));
                log.weigh(Rgb(albedo));
                open.push_back({log.branch(), here.depth + 1});
            }
        }
        PathRecords records;
        records.add(log.vertices());
        ASSERT_EQ(records.volume().size(), log.vertices().size());
        for (const Record& record : records.volume()) {
            ASSERT_NEAR(record.radiance, 1, 1e-5f);
        }
    }
}

/// The furnace with walks that end by chance, each vertex's record; `density_ratio` says whether survivors are raised.
Moments furnace_with_roulette(bool density_ratio) {
    constexpr float albedo = 0.75f;
    Moments radiance;
    PathLog log;
    for (std::uint64_t walk = 0; walk < 20000; ++walk) {
        Pcg32 random(hash_of(11, walk));
        log.start();
        do {
            log.scatter(Vec3(0, 0, 0), Vec3(0, 0, 1), inv_4pi, Rgb(1.0f), true);
            log.gather(Rgb(1 - albedo));
            log.weigh(Rgb(density_ratio ? 1.0f : albedo));
        } while (random.uniform() < albedo);
        PathRecords records;
        records.add(log.vertices());
        radiance.add(records.volume()[0].radiance);
    }
    return radiance;
}

TEST(PathRecords, AreUnbiasedUnderRoulette) {
    const Moments right = furnace_with_roulette(true);
    EXPECT_LT(std::abs(right.mean() - 1), 4 * right.standard_error());
    // The twin: survivors that are not raised.
    const Moments wrong = furnace_with_roulette(false);
    EXPECT_GT(std::abs(wrong.mean() - 1), 20 * wrong.standard_error());
}

TEST(PathRecords, ClampNothingAndLeaveTheCountToTheFit) {
    Path path = random_tree(5, true, 1);
    for (PathVertex& v : path) {
        v.arrival = v.scattering = Rgb(1.0f);
        v.gathered = Rgb();
        v.in_volume = true;
    }
    path[4].gathered = Rgb(1e20f);
    PathRecords large;
    large.add(path);
    for (const Record& record : large.volume()) {
        EXPECT_FLOAT_EQ(record.radiance, 1e20f);
    }
    path[2].gathered = Rgb(std::numeric_limits<float>::quiet_NaN());
    PathRecords records;
    records.add(path);
    const FitReport report = fit(Field::empty(Box3(Vec3(0), Vec3(1))), records.volume(), {}, 1).report;
    EXPECT_EQ(report.records, 5u);
    EXPECT_EQ(report.ignored, 3u);
}

TEST(PathRecords, LeaveOutMirrorsButNotWhatTheyShow) {
    PathLog log;
    log.scatter(Vec3(0, 0, 0), Vec3(0, 0, 1), 1, Rgb(1.0f), false);
    log.scatter(Vec3(0, 0, 1), Vec3(0, 0, -1), 0, Rgb(0.5f), false);
    log.gather(Rgb(6));
    PathRecords records;
    records.add(log.vertices());
    ASSERT_EQ(records.surface().size(), 1u);
    EXPECT_FLOAT_EQ(records.surface()[0].radiance, 3);
}

TEST(PathLog, KeepsWhatIsFoundAfterItIsFull) {
    PathLog log;
    log.start();
    log.scatter({0, 0, 0}, {0, 0, 1}, 1, Rgb(0.5f), true);
    const PathLog::Branch at_first = log.branch();
    for (std::size_t i = 1; i < PathLog::most_vertices; ++i) {
        log.scatter({0, 0, 0}, {0, 0, 1}, 1, Rgb(0.0f), true);
    }
    log.resume(at_first);
    log.weigh(Rgb(0.5f));
    log.connect({1, 0, 0}, 1, 1, Rgb(3));
    log.gather(Rgb(3));
    log.scatter({0, 0, 9}, {0, 0, 1}, 1, Rgb(0.25f), true);
    log.weigh(Rgb(0.5f));
    log.gather(Rgb(16));
    log.gather(Rgb(16));
    EXPECT_EQ(log.vertices().size(), PathLog::most_vertices);
    EXPECT_EQ(log.branch().connected, Rgb()) << "that was at the vertex left out";
    std::vector<Rgb> incident;
    incident_radiance(log.vertices(), incident);
    EXPECT_EQ(incident[0], Rgb(0.5f * (3 + 0.25f * 0.5f * 32)));
}

TEST(PathRecords, AreJoinedInOrder) {
    const Path path = random_tree(20, true, 1), more = random_tree(30, true, 2);
    PathRecords together, first, second;
    together.add(path);
    together.add(more);
    first.add(path);
    second.add(more);
    PathRecords joined = PathRecords::joined({first, second});
    EXPECT_EQ(joined.size(), path.size() + more.size());
    const auto expect_same = [](const auto& records, const auto& expected) {
        ASSERT_EQ(records.size(), expected.size());
        for (std::size_t i = 0; i < records.size(); ++i) {
            EXPECT_EQ(records[i].position, expected[i].position);
        }
    };
    expect_same(joined.surface(), together.surface());
    expect_same(joined.volume(), together.volume());
    expect_same(joined.surface_scattered(), together.surface_scattered());
    expect_same(joined.volume_scattered(), together.volume_scattered());
    joined.clear();
    EXPECT_EQ(joined.size(), 0u);
    EXPECT_TRUE(joined.surface().empty() && joined.volume().empty());
}

TEST(PathRecords, ThinLongWalksEvenly) {
    const Path path = random_tree(1000, true, 1);
    PathRecords some, all, none;
    some.add(path, 64);
    all.add(path, 1000);
    none.add({}, 64);
    Path mirrored = path;  // every other vertex is a mirror: the others must not be what thinning leaves out
    for (std::size_t i = 0; i < mirrored.size(); i += 2) {
        mirrored[i].density = 0;
    }
    PathRecords behind_mirrors;
    behind_mirrors.add(mirrored, 250);
    EXPECT_EQ(behind_mirrors.surface().size() + behind_mirrors.volume().size(), 250u);
    EXPECT_EQ(some.surface().size() + some.volume().size(), 63u);  // every 16th
    EXPECT_EQ(all.surface().size() + all.volume().size(), 1000u);
    EXPECT_EQ(none.surface().size() + none.volume().size(), 0u);
}

}  // namespace
}  // namespace wend::guide
