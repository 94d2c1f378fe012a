#include <wend/core/error.h>
#include <wend/core/random.h>
#include <wend/guide/field.h>
#include <wend/guide/fit.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>

namespace wend::guide {
namespace {

const Box3 box(Vec3(0, 0, 0), Vec3(2, 1, 1));

Records lamp_records(int count, std::uint64_t seed) {
    Pcg32 random(seed);
    Records records;
    for (int i = 0; i < count; ++i) {
        const Vec2 u = random.uniform2();
        const Vec3 position(2 * u.x, u.y, random.uniform());
        const Vmf lamp{normalize(Vec3(0.5f, 0.5f, 2) - position), 40};
        const Vec3 w = lamp.sample(random.uniform2());
        records.push_back({position, w, lamp.density(w), lamp.density(w), 1.5f});
    }
    return records;
}

Field learned() {
    FitSettings settings;
    settings.leaf_samples = 300;
    return fit(Field::empty(box), lamp_records(5000, 1), settings, 1).field;
}

TEST(Serialization, AFieldAnswersTheSameBitForBit) {
    const Field field = learned();
    const Field again = field_from_bytes(to_bytes(field));
    ASSERT_EQ(again.size(), field.size());
    EXPECT_EQ(again.bytes(), field.bytes());
    EXPECT_EQ(to_bytes(again), to_bytes(field));
    Pcg32 random(2);
    for (int i = 0; i < 1000; ++i) {
        const Vec3 position(3 * random.uniform() - 0.5f, random.uniform(), random.uniform());
        const Vec3 w = Vmf{}.sample(random.uniform2());
        EXPECT_EQ(again.find(position)->incident(position).density(w),
                  field.find(position)->incident(position).density(w));
        EXPECT_EQ(again.find(position)->fluence(), field.find(position)->fluence());
    }
}

TEST(Serialization, AFieldLearnsOnTheSame) {
    const Field field = learned();
    const Records more = lamp_records(3000, 3);
    const Field a = fit(field, more, {}, 1).field;
    const Field b = fit(field_from_bytes(to_bytes(field)), more, {}, 1).field;
    EXPECT_EQ(to_bytes(a), to_bytes(b));
    EXPECT_NE(to_bytes(a), to_bytes(field));
}

TEST(Serialization, AnEmptyFieldStaysEmpty) {
    const Field again = field_from_bytes(to_bytes(Field::empty(box)));
    EXPECT_EQ(again.find({1, 0.5f, 0.5f}), nullptr);
    EXPECT_EQ(again.bounds(), box);
}

TEST(Serialization, EveryTruncationIsRefused) {
    const std::string bytes = to_bytes(learned());
    for (std::size_t size = 0; size < bytes.size(); size += size < 200 ? 1 : 997) {
        EXPECT_THROW(field_from_bytes(bytes.substr(0, size)), InputError) << size;
    }
    EXPECT_THROW(field_from_bytes(bytes + "x"), InputError);
}

TEST(Serialization, EveryChangeIsRefused) {
    const std::string bytes = to_bytes(learned());
    Pcg32 random(4);
    for (int i = 0; i < 500; ++i) {
        std::string changed = bytes;
        const auto at = static_cast<std::size_t>(random.uniform_double() * static_cast<double>(bytes.size()));
        changed[at] = static_cast<char>(changed[at] ^ (1 << (i % 8)));
        EXPECT_THROW(field_from_bytes(changed), InputError) << at;
    }
    EXPECT_THROW(field_from_bytes("PNG or something else that is long enough"), InputError);
}

TEST(Serialization, OtherVersionsAreRefusedByNumber) {
    std::string bytes = to_bytes(learned());
    constexpr std::size_t place = 8;  // after the signature
    std::uint32_t version;
    std::memcpy(&version, bytes.data() + place, sizeof version);
    for (const std::uint32_t other : {2u, version - 1, version + 1}) {
        std::memcpy(bytes.data() + place, &other, sizeof other);
        try {
            field_from_bytes(bytes);
            FAIL() << "version " << other << " was read";
        } catch (const InputError& error) {
            EXPECT_EQ(error.what(), "guiding field: version " + std::to_string(other) +
                                        " is not known; this is version " + std::to_string(version));
        }
    }
}

TEST(Serialization, CellsFillTheBounds) {
    const Field field = learned();
    double volume = 0, records = 0;
    std::size_t cells = 0;
    field.for_each_cell([&](const Box3& cell, const Region& region, double count) {
        const Vec3 size = cell.max - cell.min;
        volume += static_cast<double>(size.x) * static_cast<double>(size.y) * static_cast<double>(size.z);
        records += count;
        ++cells;
        EXPECT_EQ(field.find((cell.min + cell.max) * 0.5f), &region);
    });
    EXPECT_EQ(cells, field.size());
    EXPECT_NEAR(volume, 2, 1e-5);
    EXPECT_NEAR(records, 5000, 1e-6);
}

}  // namespace
}  // namespace wend::guide
