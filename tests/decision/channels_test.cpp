#include <tests/sampling/verdicts.h>
#include <wend/core/random.h>
#include <wend/decision/channels.h>

#include <gtest/gtest.h>

#include <array>

namespace wend {
namespace {

TEST(Channels, ProbabilitiesFollowTheThroughput) {
    EXPECT_EQ(channel_probabilities(Rgb(2, 1, 1)), Rgb(0.5f, 0.25f, 0.25f));
    EXPECT_FLOAT_EQ(channel_probabilities(Rgb(0)).g, 1.0f / 3);
    // The inverse of so little overflows.
    EXPECT_FLOAT_EQ(channel_probabilities(Rgb(1e-40f, 0, 0)).g, 1.0f / 3);
}

TEST(Channels, FrequenciesFitAndTheRescaledNumberIsUniform) {
    const Rgb probabilities(0.2f, 0.5f, 0.3f);
    std::array<std::uint64_t, 3> observed{};
    std::array<test::Uniformity, 3> rescaled;
    Pcg32 random(1);
    constexpr int samples = 100000;
    for (int i = 0; i < samples; ++i) {
        float u = random.uniform();
        const auto channel = static_cast<std::size_t>(choose_channel(probabilities, u));
        ++observed[channel];
        rescaled[channel].add(u);
    }
    EXPECT_GE(chi_square_test(observed, std::array{0.2 * samples, 0.5 * samples, 0.3 * samples}).p_value,
              test::passing);
    EXPECT_LT(chi_square_test(observed, std::array{0.21 * samples, 0.49 * samples, 0.3 * samples}).p_value,
              test::failing);
    for (const test::Uniformity& u : rescaled) {
        EXPECT_GE(u.p_value(), test::passing);
    }
}

TEST(Channels, NeverChoosesAChannelOfNoProbability) {
    for (const Rgb& throughput :
         {Rgb(0, 1, 0), Rgb(1, 0, 0), Rgb(0, 0, 1), Rgb(0.1f, 0.2f, 0), Rgb(1, 0, 7), Rgb(0.1f, 0.6f, 0.3f)}) {
        const Rgb probabilities = channel_probabilities(throughput);
        for (int i = 0; i <= 1000; ++i) {
            float u = std::min(static_cast<float>(i) / 1000, 0x1.fffffep-1f);
            EXPECT_GT(probabilities[choose_channel(probabilities, u)], 0);
            EXPECT_GE(u, 0);
            EXPECT_LT(u, 1);
        }
    }
}

}  // namespace
}  // namespace wend
