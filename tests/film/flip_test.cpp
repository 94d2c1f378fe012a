#include <wend/core/error.h>
#include <wend/film/flip.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend {
namespace {

/// A 64x48 picture from a function of pixel coordinates.
template <class F>
Image draw(F&& colour) {
    Image image(64, 48);
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            image.at(x, y) = colour(static_cast<float>(x), static_cast<float>(y));
        }
    }
    return image;
}

/// A coloured ramp over six stops.
Rgb ramp(float x, float y) {
    const float s = 0.05f * std::exp2(x / 10);
    return s * Rgb(1 + 0.5f * std::sin(0.4f * y), 1 + 0.5f * std::cos(0.3f * x), 1 + 0.4f * std::sin(0.2f * (x + y)));
}

/// The ramp with a fine multiplicative pattern.
Image rippled_ramp(float amplitude) {
    return draw([=](float x, float y) { return ramp(x, y) * (1 + amplitude * std::sin(2.3f * x + 1.1f * y)); });
}

/// A disc of radius 12 on a dim ground.
Image disc(float centre, const Rgb& colour) {
    return draw([=](float x, float y) {
        return (x - centre) * (x - centre) + (y - 24) * (y - 24) < 144 ? colour : Rgb(0.2f, 0.25f, 0.3f);
    });
}

float value_at(const FlipResult& result, int x, int y) {
    return result.map[static_cast<std::size_t>(y * 64 + x)];
}

// The numbers of the next two tests come from the authors' program, flip-evaluator 1.7 of the Python package index:
// evaluate(reference, image, "HDR", inputsRGB=False, applyMagma=False) at its default 67.02 pixels per degree.
constexpr float evaluators_pixels_per_degree = 67.0206451f;

TEST(Flip, AgreesWithTheAuthorsProgramOnARamp) {
    const FlipResult result = flip(rippled_ramp(0.4f), draw(ramp), evaluators_pixels_per_degree);
    EXPECT_NEAR(result.mean, 0.0789458, 0.0789458 * 0.01);
    EXPECT_NEAR(*std::max_element(result.map.begin(), result.map.end()), 0.24304, 0.24304 * 0.01);
    EXPECT_NEAR(value_at(result, 20, 10), 0.084757, 0.084757 * 0.02);
    EXPECT_NEAR(value_at(result, 44, 24), 0.063696, 0.063696 * 0.02);
}

TEST(Flip, AgreesWithTheAuthorsProgramOnAShiftedDisc) {
    const FlipResult result = flip(disc(32, {3.3f, 2.4f, 1.5f}), disc(30, {3, 2.5f, 2}), evaluators_pixels_per_degree);
    EXPECT_NEAR(result.mean, 0.0920815, 0.0920815 * 0.01);
    EXPECT_NEAR(*std::max_element(result.map.begin(), result.map.end()), 0.787869, 0.787869 * 0.01);
    EXPECT_NEAR(value_at(result, 20, 10), 0.024744, 0.024744 * 0.02);
    EXPECT_NEAR(value_at(result, 44, 24), 0.679944, 0.679944 * 0.02);
}

TEST(Flip, IsZeroForIdenticalPicturesOnly) {
    EXPECT_EQ(flip(draw(ramp), draw(ramp)).mean, 0);
    EXPECT_GT(flip(rippled_ramp(0.01f), draw(ramp)).mean, 0);
}

TEST(Flip, IsSymmetricWhereBothPicturesAskForTheSameExposures) {
    // A mirrored picture has the luminances of the original, hence its exposures.
    const Image original = disc(28, {3, 2, 1});
    const Image mirrored =
        draw([&](float x, float y) { return original.at(63 - static_cast<int>(x), static_cast<int>(y)); });
    const double forth = flip(original, mirrored).mean;
    EXPECT_GT(forth, 0.01);
    EXPECT_NEAR(flip(mirrored, original).mean, forth, 1e-6);
}

TEST(Flip, GrowsWithTheDifference) {
    double previous = 0;
    for (const float amplitude : {0.05f, 0.1f, 0.2f, 0.4f, 0.8f}) {
        const double current = flip(rippled_ramp(amplitude), draw(ramp)).mean;
        EXPECT_GT(current, 1.2 * previous);
        previous = current;
    }
    EXPECT_LT(previous, 1);
}

TEST(Flip, FinePatternsFadeWithDistance) {
    EXPECT_LT(flip(rippled_ramp(0.4f), draw(ramp), 200).mean, 0.7 * flip(rippled_ramp(0.4f), draw(ramp), 30).mean);
}

TEST(Flip, SeesWhatOnlyOneExposureShows) {
    // The change lies in the shadows of a picture whose lights are 10 stops brighter.
    const auto scene = [](float shadow) {
        return draw([=](float x, float) { return x < 16 ? Rgb(50) : Rgb(shadow); });
    };
    EXPECT_GT(flip(scene(0.09f), scene(0.05f)).mean, 0.1);
}

TEST(Flip, StaysInRangeForExtremePictures) {
    const Image black(3, 2), bright(3, 2, Rgb(1e38f)), negative(3, 2, Rgb(-1));
    EXPECT_EQ(flip(black, black).mean, 0);
    EXPECT_EQ(flip(negative, black).mean, 0);
    for (const auto& [a, b] : {std::pair{black, bright}, {bright, black}}) {
        for (const float value : flip(a, b).map) {
            EXPECT_GT(value, 0.5f);
            EXPECT_LE(value, 1);
        }
    }
}

TEST(Flip, RefusesBadInput) {
    const Image good(3, 2, Rgb(1));
    EXPECT_THROW(flip(good, Image(2, 3, Rgb(1))), InputError);
    EXPECT_THROW(flip(Image(), Image()), InputError);
    EXPECT_THROW(flip(good, good, 0), InputError);
    EXPECT_THROW(flip(good, good, 1e9f), InputError);
    EXPECT_THROW(flip(good, good, std::numeric_limits<float>::quiet_NaN()), InputError);
    EXPECT_THROW(flip(Image(3, 2, Rgb(std::numeric_limits<float>::infinity())), good), InputError);
}

}  // namespace
}  // namespace wend
