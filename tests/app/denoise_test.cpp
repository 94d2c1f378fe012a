// Denoising: what is asked for where the library is, and one sentence where it is not.
#include <tests/support/scratch_folder.h>
#include <wend/app/denoiser.h>
#include <wend/app/oidn_library.h>
#include <wend/core/error.h>
#include <wend/core/random.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <optional>
#include <string>
#include <utility>
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

/// Sets a variable of the environment, and puts back what it was.
class Variable {
public:
    Variable(const char* name, const char* value) : name_(name) {
        if (const char* const old = std::getenv(name)) {
            old_ = old;
        }
        set(value);
    }
    ~Variable() { set(old_ ? old_->c_str() : nullptr); }
    Variable(const Variable&) = delete;
    Variable& operator=(const Variable&) = delete;

private:
    void set(const char* value) const { value ? setenv(name_, value, 1) : unsetenv(name_); }

    const char* name_;
    std::optional<std::string> old_;
};

TEST(Denoise, TheLibraryIsLookedForInThePythonEnvironmentAtHand) {
    const Variable none("WEND_OIDN", nullptr), no_conda("CONDA_PREFIX", nullptr);
    const test::ScratchFolder folder;
    const std::filesystem::path environment = folder.file("environment");
    const std::filesystem::path library =
        environment / "lib/python3.99/site-packages/pyoidn/oidn/lib/libOpenImageDenoise.so.2";
    std::filesystem::create_directories(library.parent_path());
    std::ofstream(library) << "a library";
    const Variable active("VIRTUAL_ENV", environment.c_str());
    const std::vector<std::string> found = oidn_candidates({});
    ASSERT_GE(found.size(), 2u);
    EXPECT_EQ(found[0], "libOpenImageDenoise.so.2") << "the system's";
    EXPECT_EQ(found[1], library.string());
    EXPECT_EQ(oidn_candidates("/there"), std::vector<std::string>{"/there"}) << "what is given is all";
    EXPECT_EQ(oidn_candidates(library.parent_path()), std::vector<std::string>{library.string()}) << "a folder";
    const Variable named("WEND_OIDN", "/named.so");
    EXPECT_EQ(oidn_candidates({}), std::vector<std::string>{"/named.so"});
}

/// A grey wall with noise, behind thin fog.
Picture noisy_wall() {
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
    return picture;
}

/// Mean distance from what the wall would be without noise.
double error_of(const Picture& picture) {
    double error = 0;
    for (const Rgb& pixel : picture.image.pixels) {
        error += std::abs(static_cast<double>(pixel.g) - 1);
    }
    return error / static_cast<double>(picture.image.pixels.size());
}

/// The library; none where it is not installed.
std::optional<Denoiser> installed_denoiser() {
    try {
        return std::optional<Denoiser>(std::in_place);
    } catch (const InputError&) {
        return std::nullopt;
    }
}

TEST(Denoise, TakesNoiseOutAndKeepsWhatWas) {
    const std::optional<Denoiser> denoiser = installed_denoiser();
    if (!denoiser) {
        GTEST_SKIP() << "Open Image Denoise is not installed";
    }
    const Picture picture = noisy_wall(), result = denoised(picture, *denoiser);
    EXPECT_LT(error_of(result), 0.1 * error_of(picture));
    ASSERT_EQ(result.layers.back().name, "noisy");
    EXPECT_EQ(result.layers.back().values[3 * 17 + 1], picture.image.pixels[17].g);
    EXPECT_EQ(result.metadata.at("wend:denoised"), "Open Image Denoise " + denoiser->version());
}

TEST(Denoise, TakesAPictureThatIsMirroredForTheSame) {
    const std::optional<Denoiser> denoiser = installed_denoiser();
    if (!denoiser) {
        GTEST_SKIP() << "Open Image Denoise is not installed";
    }
    const Picture picture = noisy_wall();
    Picture turned = picture;
    std::reverse(turned.image.pixels.begin(), turned.image.pixels.end());
    Image result = denoiser->filter(turned), straight = denoiser->filter(picture);
    std::reverse(result.pixels.begin(), result.pixels.end());
    for (std::size_t i = 0; i < result.pixels.size(); ++i) {
        ASSERT_NEAR(result.pixels[i].g, straight.pixels[i].g, 1e-4f) << "pixel " << i;
    }
}

TEST(Denoise, LightOfMediaIsDenoisedApartToo) {
    const std::optional<Denoiser> denoiser = installed_denoiser();
    if (!denoiser) {
        GTEST_SKIP() << "Open Image Denoise is not installed";
    }
    Picture picture = noisy_wall();
    const Image together = denoiser->filter(picture);
    Layer volume{"volume", {"R", "G", "B"}, {}};
    for (const Rgb& pixel : picture.image.pixels) {
        volume.values.insert(volume.values.end(), 3, 0.25f * pixel.g);
    }
    picture.layers.push_back(volume);
    const Picture result = denoised(picture, *denoiser);
    EXPECT_LT(error_of(result), 0.1 * error_of(picture));
    EXPECT_FALSE(result.image.pixels == together.pixels) << "the layer is used";
    std::fill(picture.layers.back().values.begin(), picture.layers.back().values.end(), 0.0f);
    EXPECT_TRUE(denoiser->filter(picture).pixels == together.pixels) << "and is not where no medium shows";
}

TEST(Denoise, LightOfMediaIsNotTakenApartWhereAMediumHasASharpEdge) {
    const std::optional<Denoiser> denoiser = installed_denoiser();
    if (!denoiser) {
        GTEST_SKIP() << "Open Image Denoise is not installed";
    }
    Picture picture = noisy_wall();
    const int side = picture.image.width, edge = side / 2;
    std::vector<float>& opacity = picture.layers.back().values;
    Layer volume{"volume", {"R", "G", "B"}, {}};
    for (std::size_t i = 0; i < opacity.size(); ++i) {
        const bool is_medium = static_cast<int>(i) % side >= edge;
        opacity[i] = is_medium ? 1.0f : 0.0f;
        volume.values.insert(volume.values.end(), 3, is_medium ? picture.image.pixels[i].g : 0.0f);
    }
    const Image together = denoiser->filter(picture);
    picture.layers.push_back(volume);
    const Image result = denoiser->filter(picture);
    for (int y = 0; y < side; ++y) {
        for (const int x : {edge - 2, edge - 1, edge, edge + 1}) {
            ASSERT_EQ(result.at(x, y).g, together.at(x, y).g) << x << ", " << y;
        }
    }
    EXPECT_NE(result.at(edge + 4, edge).g, together.at(edge + 4, edge).g) << "elsewhere it is";
}

}  // namespace
}  // namespace wend
