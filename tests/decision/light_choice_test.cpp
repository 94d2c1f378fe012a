#include <wend/decision/learned_lights.h>

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace wend {
namespace {

TEST(WeightedLights, AreChosenByTheirWeights) {
    const WeightedLights choice({1, 0, 5, 2, 0});
    const LightReceiver anywhere;
    std::array<int, 5> counts{};
    constexpr int draws = 8000;
    for (int i = 0; i < draws; ++i) {
        const ChosenLight chosen = choice.sample(anywhere, (static_cast<float>(i) + 0.5f) / draws);
        ASSERT_EQ(chosen.probability, choice.probability(anywhere, chosen.index));
        ++counts[static_cast<std::size_t>(chosen.index)];
    }
    EXPECT_EQ(counts, (std::array{1000, 0, 5000, 2000, 0}));
    // Where the sum of probabilities ends below u, by rounding.
    EXPECT_EQ(choice.sample(anywhere, std::nextafter(1.0f, 0.0f)).index, 3);
}

TEST(WeightedLights, BeginWhatIsLearned) {
    const WeightedLights choice({3, 1});
    const LightReceiver here{{0.5f, 0.5f, 0.5f}, {0, 0, 1}};
    EXPECT_FALSE(here.in_volume());
    EXPECT_TRUE(LightReceiver{}.in_volume());
    LearnedLights by_choice(Box3({0, 0, 0}, {1, 1, 1}), 2), by_function(Box3({0, 0, 0}, {1, 1, 1}), 2);
    EXPECT_EQ(by_choice.probability(choice, here, 0), 0.75f);
    // The weaker light is all that arrives.
    const std::vector<LightRecord> records(400, by_choice.record(here, 1, 2));
    for (LearnedLights* const lights : {&by_choice, &by_function}) {
        lights->add(records);
        lights->add(std::vector<LightRecord>(400, by_choice.record(here, 0, 0)));
    }
    by_choice.learn(choice, 1);
    by_function.learn([&](const LightReceiver& r, int light) { return choice.probability(r, light); }, 1);
    EXPECT_GT(by_choice.probability(choice, here, 1), 0.5f);
    EXPECT_EQ(by_choice.probability(choice, here, 1), by_function.probability(choice, here, 1));
}

}  // namespace
}  // namespace wend
