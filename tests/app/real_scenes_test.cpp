// Scenes that were not made for tests: the project's own, and the collection of real ones where it is at hand.
#include "program_support.h"
#include "tests/support/paths.h"

#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace wend {
namespace {

/// A name of letters and digits for a test of this scene file.
std::string test_name(std::string file) {
    for (char& c : file) {
        c = std::isalnum(static_cast<unsigned char>(c)) ? c : '_';
    }
    return file;
}

/// Mean luminance of a small render of the scene file, without its brightest pixel, where a lamp that was met by chance
/// may outshine the picture; every pixel must be finite.
double render_mean(const std::filesystem::path& scene, const std::string& resolution, const std::string& samples,
                   const std::string& sampling) {
    const test::ScratchFolder folder;
    const auto result =
        test::run_wend({"render", scene.string(), "-o", folder.file("out.exr"), "--resolution", resolution, "--spp",
                        samples, "--sampling", sampling, "--seed", "1", "--json", "-"});
    EXPECT_EQ(result.status, 0) << result.err;
    EXPECT_EQ(result.err.find("warning"), std::string::npos) << result.err;
    if (result.status != 0) {
        return 0;
    }
    EXPECT_EQ(result.json()["rejected_samples"], 0);
    const Image image = read_image(folder.file("out.exr"));
    double sum = 0, brightest = 0;
    for (const Rgb& pixel : image.pixels) {
        EXPECT_TRUE(is_finite(pixel) && min_value(pixel) >= 0);
        sum += luminance(pixel);
        brightest = std::max(brightest, static_cast<double>(luminance(pixel)));
    }
    return (sum - brightest) / static_cast<double>(image.pixels.size() - 1);
}

class OwnScene : public testing::TestWithParam<std::string> {};

TEST_P(OwnScene, RendersWithoutAWarning) {
    for (const char* sampling : {"classical", "direction"}) {
        EXPECT_GT(render_mean(test::source_dir() / "scenes" / GetParam(), "32x18", "16", sampling), 0) << sampling;
    }
}

std::vector<std::string> own_scenes() {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(test::source_dir() / "scenes")) {
        if (entry.path().extension() == ".pbrt") {
            names.push_back(entry.path().filename().string());
        }
    }
    return names;
}

INSTANTIATE_TEST_SUITE_P(Scenes, OwnScene, testing::ValuesIn(own_scenes()),
                         [](const auto& parameter) { return test_name(parameter.param); });

struct ExpectedMean {
    const char* file;
    const char* resolution;
    double mean;  ///< luminance, by a classical render of twenty seconds at this resolution
};

class RealScene : public testing::TestWithParam<ExpectedMean> {};

TEST_P(RealScene, RendersAboutAsBrightAsALongerRender) {
    const ExpectedMean& expected = GetParam();
    const auto file = test::shared_dir() / "scenes" / expected.file;
    if (!std::filesystem::exists(file)) {
        GTEST_SKIP() << "no collection of scenes beside the checkout: " << file;
    }
    for (const char* sampling : {"classical", "direction"}) {
        const double mean = render_mean(file, expected.resolution, "8", sampling);
        EXPECT_GT(mean, 0.75 * expected.mean) << sampling;
        EXPECT_LT(mean, 1.2 * expected.mean) << sampling;
    }
}

INSTANTIATE_TEST_SUITE_P(Shared, RealScene,
                         testing::Values(ExpectedMean{"cornell-box/scene-v4.pbrt", "64x64", 0.135},
                                         ExpectedMean{"veach-ajar/scene-v4.pbrt", "64x36", 1.34},
                                         ExpectedMean{"volumetric-caustic/scene-v4.pbrt", "64x64", 0.46},
                                         ExpectedMean{"fog-box/fog-box.pbrt", "64x64", 0.162},
                                         ExpectedMean{"smoke/smoke.pbrt", "64x64", 0.125},
                                         ExpectedMean{"cloud/cloud.pbrt", "64x36", 0.171},
                                         ExpectedMean{"cloud/cloud-grey.pbrt", "64x36", 0.19}),
                         [](const auto& parameter) { return test_name(parameter.param.file); });

/// What Tungsten's tone curve (Hejl and Burgess-Dawson's) makes of a linear value.
double filmic(double linear) {
    const double x = std::max(0.0, linear - 0.004);
    return x * (6.2 * x + 0.5) / (x * (6.2 * x + 1.7) + 0.06);
}

TEST(SlowRealScenes, TheCornellBoxIsThatOfTungsten) {
    const auto folder = test::shared_dir() / "scenes" / "cornell-box";
    if (!std::filesystem::exists(folder)) {
        GTEST_SKIP() << "no collection of scenes beside the checkout: " << folder;
    }
    const test::ScratchFolder scratch;
    const auto result = test::run_wend({"render", (folder / "scene-v4.pbrt").string(), "-o", scratch.file("out.exr"),
                                        "--resolution", "64x64", "--spp", "512", "--quiet"});
    ASSERT_EQ(result.status, 0) << result.err;
    const Image ours = read_image(scratch.file("out.exr"));
    const Image theirs = read_image(folder / "TungstenRender.png", ColourEncoding::linear);
    ASSERT_EQ(theirs.width, 1024);
    ASSERT_EQ(theirs.height, 1024);
    // Squares of 8 x 8 of our pixels, in the picture's own encoding. Edges of objects are convolved before the tone
    // curve here and after it there, which is much where the lamp is.
    constexpr int squares = 8;
    int far_off = 0;
    double difference = 0;
    for (int y = 0; y < squares; ++y) {
        for (int x = 0; x < squares; ++x) {
            for (int c = 0; c < 3; ++c) {
                double a = 0, b = 0;
                bool lamp = false;
                for (int i = 0; i < 64; ++i) {
                    lamp |= ours.at(8 * x + i % 8, 8 * y + i / 8)[c] > 1;
                    a += filmic(ours.at(8 * x + i % 8, 8 * y + i / 8)[c]) / 64;
                }
                for (int i = 0; i < 128 * 128; ++i) {
                    b += theirs.at(128 * x + i % 128, 128 * y + i / 128)[c] / (128.0 * 128.0);
                }
                difference += std::abs(a - b) / (3 * squares * squares);
                far_off += !lamp && std::abs(a - b) > 0.03;
            }
        }
    }
    EXPECT_LT(difference, 0.01);
    EXPECT_EQ(far_off, 0);
}

}  // namespace
}  // namespace wend
