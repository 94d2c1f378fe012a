// Processes that fit their shares of the cells learn what one process learns from all records, bit for bit.
#include <tests/support/thread_ranks.h>
#include <wend/core/random.h>
#include <wend/guide/field.h>
#include <wend/guide/shared_learning.h>
#include <wend/sampling/vmf.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace wend::guide {
namespace {

constexpr std::size_t producers = 23;

/// Walks of three vertices in a box, the light of which comes from a place within; more of them in one corner.
PathRecords walks(std::uint64_t seed, int count) {
    Pcg32 random(seed);
    const Vec3 light(0.7f, 0.6f, 0.2f);
    PathRecords records;
    for (int i = 0; i < count; ++i) {
        std::vector<PathVertex> path(3);
        for (std::size_t k = 0; k < path.size(); ++k) {
            PathVertex& vertex = path[k];
            const Vec2 u = random.uniform2();
            vertex.position = Vec3(u.x * u.x, u.y * u.y, random.uniform());
            vertex.direction = Vmf{}.sample(random.uniform2());
            vertex.density = 0.08f;
            vertex.distance = 0.5f;
            vertex.scattering = Rgb(0.5f);
            vertex.arrival = Rgb(1);
            const Vec3 to_light = light - vertex.position;
            vertex.gathered =
                Rgb(std::max(0.0f, dot(vertex.direction, to_light)) / length_squared(to_light), 0.2f, 0.1f);
            vertex.connected = Rgb(random.uniform());
            vertex.in_volume = random.uniform() < 0.4f;
            vertex.parent = static_cast<std::int32_t>(k) - 1;
        }
        records.add(path);
    }
    return records;
}

std::vector<PathRecords> pass_of(std::uint64_t pass) {
    std::vector<PathRecords> records;
    for (std::size_t i = 0; i < producers; ++i) {
        records.push_back(walks(100 * pass + i, i == 7 ? 0 : 300 << pass));
    }
    return records;
}

std::string bytes_of(const Fields& fields) {
    return to_bytes(fields.surface) + to_bytes(fields.volume);
}

const Box3 box(Vec3(0, 0, 0), Vec3(1, 1, 1));

/// Learns in so many processes, each with the records of some producers, and holds all of them against one alone.
void expect_one_learning(const FitSettings& settings, std::size_t cells_at_least) {
    constexpr std::uint64_t passes = 3;
    Fields expected{Field::empty(box), Field::empty(box)};
    for (std::uint64_t pass = 0; pass < passes; ++pass) {
        expected = learn(expected, pass_of(pass), settings, 1);
    }
    ASSERT_GE(expected.surface.size(), cells_at_least) << "too few cells to be shared";
    for (const int count : {1, 2, 3, 5}) {
        std::vector<std::string> learned(static_cast<std::size_t>(count));
        test::by_thread_ranks(count, [&](Ranks& ranks) {
            Team team(&ranks);
            Fields fields{Field::empty(box), Field::empty(box)};
            for (std::uint64_t pass = 0; pass < passes; ++pass) {
                std::vector<PathRecords> records = pass_of(pass);
                for (std::size_t i = 0; i < producers; ++i) {
                    // Not in the order of the ranks.
                    if (static_cast<int>(i * 7 % 5) % count != ranks.rank()) {
                        records[i] = {};
                    }
                }
                fields = learn_together(fields, std::move(records), 2, team, settings);
            }
            learned[static_cast<std::size_t>(ranks.rank())] = bytes_of(fields);
        });
        for (const std::string& one : learned) {
            EXPECT_TRUE(one == bytes_of(expected)) << count << " processes";
        }
    }
}

TEST(SharedLearning, IsThatOfOneProcess) {
    expect_one_learning({}, 20);
}

// Cells compete for what is left, those of other processes included: the most used ones are split.
TEST(SharedLearning, IsThatOfOneProcessWhereMemoryDoesNotSuffice) {
    FitSettings settings;
    settings.leaf_samples = 100;
    Fields fields{Field::empty(box), Field::empty(box)};
    for (std::uint64_t pass = 0; pass < 3; ++pass) {
        fields = learn(fields, pass_of(pass), settings, 1);
    }
    // From an early pass on, and in the last one alone.
    for (const std::size_t cells : {std::size_t{45}, fields.surface.size() - 3}) {
        ASSERT_LE(cells + 3, fields.surface.size()) << "there is room for all";
        settings.max_bytes = cells * Field::bytes_per_cell() + 1;
        expect_one_learning(settings, cells);
    }
}

TEST(SharedLearning, SendsEachRecordToOneProcess) {
    // All of them gathered would be sent to each of the others.
    constexpr int count = 4;
    const Fields before = learn({Field::empty(box), Field::empty(box)}, pass_of(0), 1);
    std::vector<std::uint64_t> sent(count);
    test::by_thread_ranks(count, [&](Ranks& ranks) {
        Team team(&ranks);
        std::vector<PathRecords> records = pass_of(3);
        for (std::size_t i = 0; i < producers; ++i) {
            if (static_cast<int>(i) % count != ranks.rank()) {
                records[i] = {};
            }
        }
        learn_together(before, std::move(records), 1, team);
        sent[static_cast<std::size_t>(ranks.rank())] = team.bytes_sent();
    });
    std::size_t bytes = 0;
    for (const PathRecords& one : pass_of(3)) {
        bytes += (one.surface().size() + one.volume().size()) * sizeof(Record) +
                 (one.surface_scattered().size() + one.volume_scattered().size()) * sizeof(ScatterRecord);
    }
    std::uint64_t all = 0;
    for (const std::uint64_t of_rank : sent) {
        all += of_rank;
    }
    EXPECT_GT(all, bytes / 2);
    EXPECT_LT(all, bytes * 3 / 2) << "records, of which a quarter stays, and cells";
}

}  // namespace
}  // namespace wend::guide
