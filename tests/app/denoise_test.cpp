// Denoising: what is asked for where the library is, and one sentence where it is not.
#include <wend/app/denoiser.h>
#include <wend/core/error.h>
#include <wend/core/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string>
#include <vector>

namespace wend {
namespace {

TEST(Denoise, WhereTheLibraryIsNotOneSentenceSaysSo) {
    try {
        const Denoiser denoiser("/nowhere/libOpenImageDenoise.so.2");
        FAIL();
    } catch (const InputError& error) {
        const std::string text = error.what();
        EXPECT_NE(text.find("--oidn PATH"), std::string::npos) << text;
        EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 0);
    }
    EXPECT_THROW(Denoiser("libm.so.6"), InputError) << "another library";
}

TEST(Denoise, TakesNoiseOutAndKeepsWhatWas) {
    if (!std::getenv("WEND_OIDN")) {
        GTEST_SKIP() << "WEND_OIDN does not say where Open Image Denoise is";
    }
    // A grey wall with noise, behind fog on its left half.
    constexpr int side = 64;
    Picture picture;
    picture.image = Image(side, side);
    Layer albedo{"albedo", {"R", "G", "B"}, std::vector<float>(3 * side * side, 0.5f)};
    Layer normal{"normal", {"X", "Y", "Z"}, std::vector<float>(3 * side * side, 0.0f)};
    Layer scatter{"scatter", {"P"}, std::vector<float>(side * side, 0.3f)};
    Pcg32 random(1);
    for (Rgb& pixel : picture.image.pixels) {
        pixel = Rgb(random.uniform() < 0.25f ? 4.0f : 0.0f);
    }
    picture.layers = {albedo, normal, scatter};
    const Denoiser denoiser;
    const Picture result = denoised(picture, denoiser);
    double error = 0, before = 0;
    for (std::size_t i = 0; i < result.image.pixels.size(); ++i) {
        error += std::abs(static_cast<double>(result.image.pixels[i].g) - 1) / (side * side);
        before += std::abs(static_cast<double>(picture.image.pixels[i].g) - 1) / (side * side);
    }
    EXPECT_LT(error, 0.1 * before);
    ASSERT_EQ(result.layers.back().name, "noisy");
    EXPECT_EQ(result.layers.back().values[3 * 17 + 1], picture.image.pixels[17].g);
    EXPECT_EQ(result.metadata.at("wend:denoised"), "Open Image Denoise " + denoiser.version());
}

}  // namespace
}  // namespace wend
