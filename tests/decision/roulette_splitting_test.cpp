#include <wend/decision/roulette_splitting.h>

#include <gtest/gtest.h>

#include <limits>
#include <optional>

namespace wend {
namespace {

constexpr double noisy = std::numeric_limits<double>::infinity();

TEST(ClassicalRoulette, FollowsTheBrightestChannelAfterAStart) {
    const ClassicalRoulette survival;
    EXPECT_EQ(survival.after_direction({Rgb(0.01f), 1, 1, 0}), 1);
    EXPECT_EQ(survival.after_direction({Rgb(0.01f), 1, 1, 1}), 1);
    EXPECT_FLOAT_EQ(survival.after_direction({Rgb(0.1f, 0.3f, 0.2f), 1, 1, 2}), 0.3f);
    EXPECT_EQ(survival.after_direction({Rgb(5), 1, 1, 2}), 1);
}

TEST(ClassicalRoulette, EnteringADenserMediumDoesNotEndWalks) {
    // Radiance is 1/n² there; undone by the index scale.
    EXPECT_FLOAT_EQ(ClassicalRoulette().after_direction({Rgb(1 / 2.25f), 1, 2.25f, 2}), 1);
}

TEST(ClassicalRoulette, MayEndWalksInMediaAsAbsorptionWould) {
    WalkState state{Rgb(0.4f), 1, 1, 3};
    EXPECT_FLOAT_EQ(unguided_walks_end.after_direction(state), 0.8f);
    EXPECT_FLOAT_EQ(guided_walks_end.after_direction(state), 1);
    state.in_volume = true;
    EXPECT_FLOAT_EQ(unguided_walks_end.after_direction(state), 0.4f);
    EXPECT_FLOAT_EQ(guided_walks_end.after_direction(state), 1);
}

TEST(ClassicalRoulette, SparesGuidedWalksUntilLittleIsLeft) {
    EXPECT_EQ(guided_walks_end.after_direction({Rgb(0.13f), 1, 1, 5}), 1);
    EXPECT_FLOAT_EQ(guided_walks_end.after_direction({Rgb(0.05f), 1, 1, 5}), 0.4f);
    // What a guide's densities took from the throughput does not count.
    EXPECT_EQ(guided_walks_end.after_direction({Rgb(0.05f), 3, 1, 5}), 1);
}

/// Continuations in the mean, each counted with the weight it goes on with.
struct Continuations {
    double weight = 0, copies = 0;
    bool judged = true;
};

Continuations mean_continuations(const AdjointRouletteSplitting& survival, const ExpectedContribution& expected) {
    constexpr int count = 40000;
    Pcg32 random(1);
    Continuations mean;
    for (int i = 0; i < count; ++i) {
        const std::optional<WeightWindow::Outcome> outcome = survival.before_direction(expected, random);
        mean.judged = mean.judged && outcome;
        mean.weight += outcome ? outcome->copies / outcome->expected / count : 0;
        mean.copies += outcome ? outcome->copies / static_cast<double>(count) : 0;
    }
    return mean;
}

Continuations mean_continuations(const AdjointRouletteSplitting& survival, std::optional<float> ratio, int room = 64) {
    return mean_continuations(survival, ExpectedContribution{ratio, 1, room});
}

TEST(AdjointRouletteSplitting, KeepsTheExpectedWeight) {
    const AdjointRouletteSplitting survival(true, true, noisy);
    for (const float ratio : {0.0f, 0.01f, 0.3f, 0.5f, 1.0f, 1.6f, 2.5f, 17.3f, 1e9f}) {
        const Continuations mean = mean_continuations(survival, ratio);
        ASSERT_TRUE(mean.judged);
        // The standard error is at most sqrt(1/0.5 - 1) / 200.
        EXPECT_NEAR(mean.weight, 1, 0.02) << ratio;
    }
    EXPECT_NEAR(mean_continuations(survival, 1.0f).copies, 1, 1e-9);
    EXPECT_NEAR(mean_continuations(survival, 17.3f).copies, 17.3, 0.02);
    // No walk is left with more than twice its weight.
    EXPECT_NEAR(mean_continuations(survival, 1e-6f).copies, 0.5, 0.01);
}

TEST(AdjointRouletteSplitting, IsReluctantToEndWalksWhereSamplesVaryLittle) {
    // A second moment of four times the variance halves the window's lower edge.
    const AdjointRouletteSplitting quiet(true, true, 1.0 / 3);
    EXPECT_NEAR(mean_continuations(quiet, 0.084f).copies, 1, 1e-9);
    EXPECT_NEAR(mean_continuations(quiet, 0.083f).copies, 0.5, 0.01);
    EXPECT_NEAR(mean_continuations(AdjointRouletteSplitting(true, true, noisy), 0.167f).copies, 1, 1e-9);
    EXPECT_NEAR(mean_continuations(AdjointRouletteSplitting(true, true, noisy), 0.166f).copies, 0.5, 0.01);
    // Splitting does not depend on it.
    EXPECT_NEAR(mean_continuations(quiet, 2.5f).copies, 2.5, 0.02);
    // What is worth a sixtieth is ended without any noise, or where that is not known.
    for (const double variance : {0.0, 1e-6, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_NEAR(mean_continuations(AdjointRouletteSplitting(true, true, variance), 0.017f).copies, 1, 1e-9);
        EXPECT_NEAR(mean_continuations(AdjointRouletteSplitting(true, true, variance), 0.0166f).copies, 0.5, 0.01);
    }
}

TEST(AdjointRouletteSplitting, LackOfRoomLowersTheSplittingAndDropsNothing) {
    const AdjointRouletteSplitting survival(true, true, noisy);
    for (const int room : {1, 3}) {
        const Continuations mean = mean_continuations(survival, 40.0f, room);
        EXPECT_NEAR(mean.copies, room, 1e-9);
        EXPECT_NEAR(mean.weight, 1, 1e-9);
    }
}

TEST(AdjointRouletteSplitting, SplitsWhatIsHeavierThanItBegan) {
    const AdjointRouletteSplitting survival(true, true, noisy);
    for (const std::optional<float> ratio : {std::optional<float>(), {0.01f}, {1.0f}, {2.0f}}) {
        const Continuations mean = mean_continuations(survival, ExpectedContribution{ratio, 2.5f, 64});
        ASSERT_TRUE(mean.judged);
        EXPECT_NEAR(mean.copies, 2.5, 0.02);
        EXPECT_NEAR(mean.weight, 1, 0.01);
    }
    EXPECT_NEAR(mean_continuations(survival, ExpectedContribution{4.0f, 2.5f, 64}).copies, 4, 1e-9);
    EXPECT_NEAR(mean_continuations(survival, ExpectedContribution{std::nullopt, 40, 3}).copies, 3, 1e-9);
    // What has kept its weight or lost some is judged by what is expected alone.
    EXPECT_FALSE(mean_continuations(survival, ExpectedContribution{std::nullopt, 1.5f, 64}).judged);
    EXPECT_NEAR(mean_continuations(survival, ExpectedContribution{2.5f, 0.1f, 64}).copies, 2.5, 0.02);
    EXPECT_FALSE(
        mean_continuations(AdjointRouletteSplitting(true, false, noisy), ExpectedContribution{std::nullopt, 2.5f, 64})
            .judged);
}

TEST(AdjointRouletteSplitting, LeavesToTheWeightWhatItMayNotJudge) {
    EXPECT_FALSE(mean_continuations(AdjointRouletteSplitting(true, true, noisy), std::nullopt).judged);
    EXPECT_FALSE(mean_continuations(AdjointRouletteSplitting(false, true, noisy), 0.1f).judged);
    EXPECT_TRUE(mean_continuations(AdjointRouletteSplitting(false, true, noisy), 3.0f).judged);
    EXPECT_FALSE(mean_continuations(AdjointRouletteSplitting(true, false, noisy), 3.0f).judged);
    EXPECT_TRUE(mean_continuations(AdjointRouletteSplitting(true, false, noisy), 0.1f).judged);
    const WalkState state{Rgb(0.02f), 1, 1, 3};
    EXPECT_EQ(AdjointRouletteSplitting(true, true, noisy).after_direction(state),
              guided_walks_end.after_direction(state));
}

TEST(AdjointRouletteSplitting, EndsButTheWorthlessOfThoseThatAreJudgedElsewhere) {
    const AdjointRouletteSplitting survival(true, true, noisy);
    EXPECT_EQ(survival.after_direction({Rgb(0.2f), 1, 1, 3, true}), 1);
    EXPECT_FLOAT_EQ(survival.after_direction({Rgb(1e-6f), 1, 1, 3, true}), 0.01f);
    const WalkState state{Rgb(0.02f), 1, 1, 3, true};
    EXPECT_EQ(AdjointRouletteSplitting(false, true, noisy).after_direction(state),
              guided_walks_end.after_direction(state));
}

TEST(ExpectedContribution, IsThroughputTimesInScatteredLightOverTheValue) {
    struct Known {
        std::optional<Rgb> light;
        std::optional<Rgb> in_scattered() const { return light; }
    };
    const Known known{Rgb(4, 2, 1)}, nothing{};
    const Rgb throughput(1, 0.5f, 0.5f), albedo(0.5f, 1, 1);
    const auto expected = ExpectedContribution::at(known, albedo, throughput, 2, 7);
    EXPECT_FLOAT_EQ(expected.ratio.value(), (2 + 1 + 0.5f) / 3 / 2);
    EXPECT_FLOAT_EQ(expected.weight, 2.0f / 3);
    EXPECT_EQ(expected.split_capacity, 7);
    EXPECT_FALSE(ExpectedContribution::at(known, albedo, throughput, 0, 1).ratio);
    EXPECT_FALSE(ExpectedContribution::at(nothing, albedo, throughput, 2, 1).ratio);
}

}  // namespace
}  // namespace wend
