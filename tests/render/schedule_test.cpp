// How many samples each pass takes; of a timed render by a clock that tells what it is told.
#include <wend/render/schedule.h>

#include <gtest/gtest.h>

#include <vector>

namespace wend {
namespace {

/// The passes of a render whose samples take so long each.
std::vector<int> passes(const RenderSettings& settings, double seconds_per_sample, int most = 100) {
    const Schedule schedule(settings);
    std::vector<int> result;
    int done = 0;
    for (int pass = 0; pass < most; ++pass) {
        const int samples = schedule.next(pass, done, done * seconds_per_sample);
        if (samples == 0) {
            break;
        }
        result.push_back(samples);
        done += samples;
    }
    return result;
}

TEST(Schedule, PassesDoubleUpToTheSamplesAskedFor) {
    RenderSettings settings;
    settings.samples = 112;
    EXPECT_EQ(passes(settings, 1), (std::vector<int>{1, 2, 4, 8, 16, 32, 32, 17}));
}

TEST(Schedule, ASmallRestIsNoPassOfItsOwn) {
    RenderSettings settings;
    settings.samples = 64;
    EXPECT_EQ(passes(settings, 1), (std::vector<int>{1, 2, 4, 8, 16, 33}));
    settings.samples = 100;
    EXPECT_EQ(passes(settings, 1), (std::vector<int>{1, 2, 4, 8, 16, 32, 37}));
    settings.samples = 3;
    EXPECT_EQ(passes(settings, 1), (std::vector<int>{1, 2}));
    settings.samples = 2;
    EXPECT_EQ(passes(settings, 1), (std::vector<int>{1, 1}));
}

TEST(Schedule, PassesOfAnEarlierRunAreRepeated) {
    RenderSettings settings;
    settings.passes = {3, 1, 7};
    settings.seconds = 1;
    EXPECT_EQ(passes(settings, 100), settings.passes);
}

TEST(Schedule, ATimedRunKeepsToItsTime) {
    RenderSettings settings;
    settings.seconds = 10;
    EXPECT_EQ(passes(settings, 0.25), (std::vector<int>{1, 2, 4, 8, 13, 6, 3, 3})) << "40 samples take 10 seconds";
    EXPECT_EQ(passes(settings, 20), (std::vector<int>{1})) << "one sample at least";
    EXPECT_EQ(passes(settings, 3.7), (std::vector<int>{1, 1, 1})) << "the third will be cut";
    EXPECT_EQ(passes(settings, 4.9), (std::vector<int>{1, 1})) << "0.2 seconds are not worth a third";
}

TEST(Schedule, LongTimesStillMakeLongPasses) {
    // Far more samples would fit into the time than an int can count.
    RenderSettings settings;
    settings.seconds = 1e9;
    EXPECT_EQ(passes(settings, 1e-9, 7), (std::vector<int>{1, 2, 4, 8, 16, 32, 32}));
}

}  // namespace
}  // namespace wend
