// Pictures against those of pbrt-v4, another renderer with its own theory, code and random numbers.
#include "tests/support/loaded_settings.h"
#include "tests/support/paths.h"

#include <wend/io/image_file.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

struct Case {
    const char* name;
    const char* large_scene;  ///< in the folder of those, if it is not beside the references
    const char* preset;
    int samples;
};

/// Luminance of a part of a picture.
struct MeasuredPart {
    double mean = 0;
    double variance = 0;  ///< of the mean
};

/// A picture as luminance and its variance, pixel by pixel.
struct NoisyPicture {
    int width = 0;
    int height = 0;
    std::vector<double> luminance;
    std::vector<double> variance;

    MeasuredPart measure(const PixelRect& part) const {
        MeasuredPart result;
        for (int y = part.min.y; y < part.max.y; ++y) {
            for (int x = part.min.x; x < part.max.x; ++x) {
                const auto i = static_cast<std::size_t>(y * width + x);
                result.mean += luminance[i];
                result.variance += variance[i];
            }
        }
        const double pixels = static_cast<double>(part.width()) * part.height();
        result.mean /= pixels;
        result.variance /= pixels * pixels;
        return result;
    }
    PixelRect all() const { return {{0, 0}, {width, height}}; }
};

/// The mean of two independent pictures; their difference tells its noise.
NoisyPicture mean_of(const Image& a, const Image& b) {
    NoisyPicture result{a.width, a.height, {}, {}};
    for (std::size_t i = 0; i < a.pixels.size(); ++i) {
        const double la = luminance(a.pixels[i]);
        const double lb = luminance(b.pixels[i]);
        result.luminance.push_back((la + lb) / 2);
        result.variance.push_back((la - lb) * (la - lb) / 4);
    }
    return result;
}

/// A grey picture with its variance layer.
NoisyPicture with_noise(const Picture& picture) {
    const auto layer =
        std::find_if(picture.layers.begin(), picture.layers.end(), [](const Layer& l) { return l.name == "variance"; });
    NoisyPicture result{picture.image.width, picture.image.height, {}, {}};
    for (std::size_t i = 0; i < picture.image.pixels.size(); ++i) {
        result.luminance.push_back(luminance(picture.image.pixels[i]));
        result.variance.push_back(layer->values[3 * i]);
    }
    return result;
}

bool agree(const MeasuredPart& ours, const MeasuredPart& theirs, double standard_errors, double slack) {
    return std::abs(ours.mean - theirs.mean) <=
           standard_errors * std::sqrt(ours.variance + theirs.variance) + slack * theirs.mean;
}

/// What of the picture disagrees with the reference, if all of ours were `factor` times as bright: the number of blocks
/// of 12 x 12 pixels (beyond their noise and 1 %), and whether the whole does (0.5 %).
struct Disagreement {
    int blocks = 0;
    bool whole = false;
};

Disagreement compare(const NoisyPicture& ours, const NoisyPicture& theirs, double factor = 1) {
    constexpr int side = 12;
    const auto scaled = [&](const PixelRect& part) {
        const MeasuredPart m = ours.measure(part);
        return MeasuredPart{m.mean * factor, m.variance * factor * factor};
    };
    Disagreement result;
    for (int y = 0; y < ours.height; y += side) {
        for (int x = 0; x < ours.width; x += side) {
            const PixelRect block{{x, y}, {std::min(x + side, ours.width), std::min(y + side, ours.height)}};
            result.blocks += !agree(scaled(block), theirs.measure(block), 4, 0.01);
        }
    }
    result.whole = !agree(scaled(ours.all()), theirs.measure(theirs.all()), 2.5, 0.005);
    return result;
}

class PbrtReference : public testing::TestWithParam<Case> {};

TEST_P(PbrtReference, AgreesBlockByBlock) {
    const Case& c = GetParam();
    const auto references = test::source_dir() / "tests/references";
    const auto beside = references / (std::string(c.name) + ".pbrt");
    const auto scene_file = std::filesystem::exists(beside) ? beside : test::shared_dir() / "scenes" / c.large_scene;
    if (!std::filesystem::exists(scene_file)) {
        GTEST_SKIP() << "a large scene that is not here: " << scene_file;
    }
    const std::string name = c.name;
    const NoisyPicture theirs =
        mean_of(read_image(references / (name + "-1.exr")), read_image(references / (name + "-2.exr")));

    LoadedScene loaded = load_scene(scene_file);
    Film film(loaded.resolution, loaded.crop);
    RenderSettings settings = test::settings_of(loaded, c.preset, c.samples);
    settings.seed = 1;
    settings.exposure = loaded.exposure;
    settings.balance = loaded.balance;
    ASSERT_EQ(settings.sampler, SamplerKind::independent) << "or else the variance layer is an overestimate";
    const Scene scene(std::move(loaded.scene));
    render(scene, film, settings);
    const NoisyPicture ours = with_noise(film.picture());
    ASSERT_EQ(ours.width, theirs.width);
    ASSERT_EQ(ours.height, theirs.height);

    const Disagreement found = compare(ours, theirs);
    const double ratio = ours.measure(ours.all()).mean / theirs.measure(theirs.all()).mean;
    EXPECT_EQ(found.blocks, 0);
    EXPECT_FALSE(found.whole) << "ours / theirs: " << ratio;
    for (const double bias : {0.98, 1.02}) {
        const Disagreement biased = compare(ours, theirs, bias);
        EXPECT_TRUE(biased.whole || biased.blocks > 0) << "a bias of 2 % must be noticed: " << bias;
    }
}

INSTANTIATE_TEST_SUITE_P(SlowScenes, PbrtReference,
                         testing::Values(Case{"fog-box", "", "classical", 600}, Case{"fog-box", "", "direction", 300},
                                         Case{"fog-box-filled", "", "full", 160},
                                         Case{"cloud-grey", "cloud/cloud-grey.pbrt", "classical", 224}),
                         [](const auto& parameter) {
                             std::string name = std::string(parameter.param.name) + "_" + parameter.param.preset;
                             std::replace(name.begin(), name.end(), '-', '_');
                             return name;
                         });

}  // namespace
}  // namespace wend
