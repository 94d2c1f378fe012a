#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>

namespace wend {
namespace {

TEST(Mix, IsTheFinalizerOfSplitmix64) {
    constexpr std::uint64_t golden = 0x9e3779b97f4a7c15ull;
    std::uint64_t state = 1234567;
    for (const std::uint64_t expected : {6457827717110365317ull, 3203168211198807973ull, 9817491932198370423ull,
                                         4593380528125082431ull, 16408922859458223821ull}) {
        EXPECT_EQ(mix(state += golden), expected);
    }
}

TEST(HashOf, DependsOnOrderAndNumberOfKeys) {
    EXPECT_NE(hash_of(1, 2), hash_of(2, 1));
    EXPECT_NE(hash_of(1), hash_of(1, 0));
    EXPECT_NE(hash_of(0), hash_of(0, 0));
    EXPECT_EQ(hash_of(3, 4, 5), hash_of(3, 4, 5));
}

TEST(HashOf, HalfTheBitsChangeWithOneBitOfAKey) {
    int changed = 0;
    for (int bit = 0; bit < 64; ++bit) {
        changed += __builtin_popcountll(hash_of(7, std::uint64_t{12345} ^ (std::uint64_t{1} << bit), 9) ^
                                        hash_of(7, 12345, 9));
    }
    // 4096 fair coins have a standard deviation of 32.
    EXPECT_NEAR(changed, 2048, 4 * 32);
}

TEST(UnitFloat, StaysBelowOne) {
    EXPECT_EQ(to_unit_float(0), 0.0f);
    EXPECT_EQ(to_unit_float(0xffffffffu), one_minus_epsilon);
}

TEST(Pcg32, PairsOfNumbersAreUniform) {
    for (const std::uint64_t key : {0, 1, 2}) {
        Pcg32 random(key);
        test::Uniformity pairs;
        for (int i = 0; i < 100000; ++i) {
            pairs.add(random.uniform2());
        }
        EXPECT_GE(pairs.p_value(), test::passing) << "key " << key;
    }
}

TEST(Pcg32, FirstNumbersOfNeighbouringStreamsAreUncorrelated) {
    test::Uniformity pairs;
    for (std::uint64_t key = 0; key < 100000; ++key) {
        pairs.add(Vec2(Pcg32(key).uniform(), Pcg32(key + 1).uniform()));
    }
    EXPECT_GE(pairs.p_value(), test::passing);
}

TEST(Pcg32, SlightlySkewedNumbersAreRejected) {
    Pcg32 random(1);
    test::Uniformity numbers;
    for (int i = 0; i < 100000; ++i) {
        numbers.add(std::pow(random.uniform(), 1.03f));
    }
    EXPECT_LT(numbers.p_value(), test::failing);
}

TEST(Pcg32, DoublesAreUniformInTheirHighAndTheirLowBits) {
    Pcg32 random(3);
    test::Uniformity whole;
    test::Uniformity low;
    for (int i = 0; i < 100000; ++i) {
        const double u = random.uniform_double();
        ASSERT_GE(u, 0);
        ASSERT_LT(u, 1);
        EXPECT_EQ(u * 0x1p53, std::floor(u * 0x1p53));
        whole.add(u);
        low.add(std::fmod(u * 0x1p47, 1.0));
    }
    EXPECT_GE(whole.p_value(), test::passing);
    EXPECT_GE(low.p_value(), test::passing);
}

TEST(Pcg32, TheLowBitsOfAFloatAreRejectedAsADouble) {
    Pcg32 random(3);
    test::Uniformity low;
    for (int i = 0; i < 100000; ++i) {
        low.add(std::fmod(random.uniform() * 0x1p47, 1.0));
    }
    EXPECT_LT(low.p_value(), test::failing);
}

}  // namespace
}  // namespace wend
