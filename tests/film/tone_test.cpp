#include <wend/film/tone.h>

#include <gtest/gtest.h>

#include <limits>

namespace wend {
namespace {

TEST(Tone, EncodesKnownSrgbValues) {
    EXPECT_EQ(encode_srgb(0), 0);
    EXPECT_EQ(encode_srgb(1), 255);
    EXPECT_EQ(encode_srgb(0.0031308f), 10);  // 12.92 · 0.0031308 · 255 = 10.3: the end of the linear part
    EXPECT_EQ(encode_srgb(0.18f), 118);
    EXPECT_EQ(encode_srgb(0.5f), 188);
}

TEST(Tone, ClampsWhatADisplayCannotShow) {
    EXPECT_EQ(encode_srgb(-1), 0);
    EXPECT_EQ(encode_srgb(7), 255);
    EXPECT_EQ(encode_srgb(std::numeric_limits<float>::infinity()), 255);
    EXPECT_EQ(encode_srgb(std::numeric_limits<float>::quiet_NaN()), 0);
}

TEST(Tone, EveryByteSurvivesTheRoundTrip) {
    for (int byte = 0; byte < 256; ++byte) {
        EXPECT_EQ(encode_srgb(decode_srgb(static_cast<std::uint8_t>(byte))), byte);
    }
}

TEST(Tone, ExposureIsInStops) {
    EXPECT_EQ(expose(Image(1, 1, {1, 2, 3}), 2).pixels[0], Rgb(4, 8, 12));
    EXPECT_EQ(expose(Image(1, 1, {1, 2, 3}), -1).pixels[0], Rgb(0.5f, 1, 1.5f));
}

TEST(Tone, BytesAreRowMajorRgb) {
    Image image(2, 1);
    image.pixels = {Rgb(1, 0, 0), Rgb(0, 0, 0.5f)};
    EXPECT_EQ(to_srgb8(image), (std::vector<std::uint8_t>{255, 0, 0, 0, 0, 188}));
}

}  // namespace
}  // namespace wend
