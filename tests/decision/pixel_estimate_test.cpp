#include <wend/core/random.h>
#include <wend/decision/roulette_splitting.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

TEST(PixelEstimates, AnEvenPictureIsItselfAndItsFloor) {
    for (const int samples : {1, 100, 100000}) {
        for (const float estimate : pixel_estimates(Image(7, 5, Rgb(1, 2, 3)), samples)) {
            EXPECT_NEAR(estimate, 2 * std::sqrt(1.01), 1e-5);
        }
    }
}

TEST(PixelEstimates, ABlackPictureHasNone) {
    for (const float estimate : pixel_estimates(Image(3, 3), 1)) {
        EXPECT_EQ(estimate, 0);
    }
}

TEST(PixelEstimates, NoiseIsAveragedAsLongAsSamplesAreFew) {
    Image noisy(64, 64);
    Pcg32 random(1);
    for (Rgb& pixel : noisy.pixels) {
        pixel = Rgb(random.uniform() < 0.01f ? 100.0f : 0.0f);
    }
    const std::vector<float> early = pixel_estimates(noisy, 1), late = pixel_estimates(noisy, 100000);
    const std::size_t middle = 32 * 64 + 32;
    EXPECT_NEAR(early[middle], 1, 0.35);
    EXPECT_TRUE(late[middle] < 0.2f || late[middle] > 5);
}

TEST(PixelEstimates, DarkPixelsAreMeasuredAgainstTheMean) {
    Image picture(101, 1, Rgb(1.0f));
    picture.at(50, 0) = Rgb(0.0f);
    const std::vector<float> estimates = pixel_estimates(picture, 100000);
    // A radius of 1 is the least.
    EXPECT_NEAR(estimates[50], std::hypot(2.0 / 3, 0.1 * 100 / 101), 1e-4);
    EXPECT_NEAR(estimates[0], std::hypot(1.0, 0.1 * 100 / 101), 1e-4);
}

}  // namespace
}  // namespace wend
