#include <wend/core/error.h>
#include <wend/guide/record_sample.h>

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace wend::guide {
namespace {

/// Records whose position tells when they came.
Records numbered(int first, int count) {
    Records records;
    for (int i = first; i < first + count; ++i) {
        records.push_back({Vec3(static_cast<float>(i), 0, 0), Vec3(0, 0, 1), 1, 0.5f, 2});
    }
    return records;
}

double mean_number(const Records& records) {
    double sum = 0;
    for (const Record& record : records) {
        sum += record.position.x;
    }
    return sum / static_cast<double>(records.size());
}

TEST(RecordSample, KeepsAllThatThereIsRoomFor) {
    RecordSample sample(100);
    sample.add(numbered(0, 60));
    sample.add(numbered(60, 40));
    EXPECT_EQ(sample.seen(), 100u);
    ASSERT_EQ(sample.records().size(), 100u);
    for (std::size_t i = 0; i < 100; ++i) {
        EXPECT_EQ(sample.records()[i].position.x, static_cast<float>(i));
    }
}

TEST(RecordSample, OfMoreEachIsEquallyLikelyToBeKept) {
    constexpr int count = 100000, most = 5000;
    RecordSample sample(most);
    for (int i = 0; i < count; i += 1000) {
        sample.add(numbered(i, 1000));
    }
    EXPECT_EQ(sample.seen(), static_cast<std::uint64_t>(count));
    ASSERT_EQ(sample.records().size(), static_cast<std::size_t>(most));
    // The mean of `most` numbers from 0 to count - 1, drawn without repetition.
    const double expected = (count - 1) / 2.0;
    const double error = count / std::sqrt(12.0 * most) * std::sqrt(1 - static_cast<double>(most) / count);
    EXPECT_LT(std::abs(mean_number(sample.records()) - expected), 4 * error);
    const Records late(sample.records().begin() + most / 10, sample.records().end());
    EXPECT_LT(std::abs(mean_number(late) - expected), 4.5 * error) << "no place is special";
    EXPECT_GT(std::abs(mean_number(numbered(0, most)) - expected), 4 * error) << "the first ones alone are no sample";
}

TEST(RecordSample, LeavesOutWhatTeachesNothing) {
    Records records = numbered(0, 3);
    records[1].radiance = std::numeric_limits<float>::quiet_NaN();
    RecordSample sample;
    sample.add(records);
    EXPECT_EQ(sample.seen(), 2u);
    EXPECT_EQ(sample.records().size(), 2u);
}

TEST(RecordSample, BytesAreReadBackAndEveryChangeIsRefused) {
    RecordSample sample(50);
    sample.add(numbered(0, 300));
    const std::string bytes = to_bytes(sample);
    const RecordSample again = record_sample_from_bytes(bytes);
    EXPECT_EQ(again.seen(), 300u);
    EXPECT_EQ(to_bytes(again), bytes);
    for (std::size_t at = 0; at < bytes.size(); at += at < 40 ? 1 : 61) {
        std::string changed = bytes;
        changed[at] = static_cast<char>(changed[at] ^ 4);
        EXPECT_THROW(record_sample_from_bytes(changed), InputError) << at;
        EXPECT_THROW(record_sample_from_bytes(std::string_view(bytes).substr(0, at)), InputError) << at;
    }
    EXPECT_THROW(record_sample_from_bytes(bytes + "x"), InputError);
    EXPECT_TRUE(record_sample_from_bytes(to_bytes(RecordSample())).records().empty());
}

}  // namespace
}  // namespace wend::guide
