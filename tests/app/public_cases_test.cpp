// Scenes of tests/cases: what was reported to other renderers, each with its right mean, rendered as anybody would.
#include "program_support.h"
#include "tests/support/channel_means.h"
#include "tests/support/loaded_settings.h"
#include "tests/support/paths.h"

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace wend {
namespace {

struct Expected {
    double mean[3] = {0, 0, 0};
    double tolerance[3] = {0, 0, 0};
};

/// What the head of a scene says: "# Right mean: R G B within T %", or a T for each channel.
Expected read_expected(const std::string& scene) {
    static const std::regex line("# Right mean: (.*) within (.*) %\n");
    std::smatch found;
    Expected expected;
    if (!std::regex_search(scene, found, line)) {
        ADD_FAILURE() << "the scene does not say its right mean";
        return expected;
    }
    std::istringstream means(found[1]), tolerances(found[2]);
    double percent = 0;
    for (int c = 0; c < 3; ++c) {
        means >> expected.mean[c];
        if (double next = 0; tolerances >> next) {
            percent = next;
        }
        expected.tolerance[c] = percent / 100 * expected.mean[c];
    }
    EXPECT_TRUE(means) << found[1];
    return expected;
}

/// Renders with what the scene and the defaults of `wend render` say, until the means are known well enough; the
/// samples are those of the scene.
void expect_right_mean(const std::filesystem::path& file, const char* preset = "full") {
    const Expected expected = read_expected(test::read_text(file));
    LoadedScene loaded = load_scene(file);
    RenderSettings settings = test::settings_of(loaded, preset, loaded.samples);
    settings.subsurface = parse_subsurface("auto");
    settings.exposure = loaded.exposure;
    settings.balance = loaded.balance;
    const Scene scene(std::move(loaded.scene));
    constexpr double rounding = 1e-6;
    constexpr std::uint64_t least_renders = 5, most_renders = 12;
    test::ChannelMeans means;
    const auto is_enough = [&] {
        bool enough = settings.seed > least_renders;
        for (int c = 0; c < 3; ++c) {
            enough &= 4 * means[c].standard_error() <= expected.tolerance[c] + rounding;
        }
        return enough;
    };
    for (settings.seed = 1; settings.seed <= most_renders && !is_enough(); ++settings.seed) {
        Film film(loaded.resolution, loaded.crop);
        EXPECT_EQ(render(scene, film, settings).counts.rejected, 0u);
        means.add(film.beauty());
    }
    for (int c = 0; c < 3; ++c) {
        const double mean = means[c].mean(), error = means[c].standard_error();
        SCOPED_TRACE(fmt::format("channel {}: {:.6f} +- {:.6f}, right is {}", c, mean, error, expected.mean[c]));
        EXPECT_LE(std::abs(mean - expected.mean[c]), expected.tolerance[c] + rounding);
        EXPECT_LE(3 * error, expected.tolerance[c] + rounding) << "too few samples to tell";
    }
}

std::filesystem::path cases_folder() {
    return test::source_dir() / "tests" / "cases";
}

std::vector<std::string> cases(const std::filesystem::path& folder, const char* extension = ".pbrt") {
    std::vector<std::string> names;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() == extension) {
            names.push_back(entry.path().stem().string());
        }
    }
    std::sort(names.begin(), names.end());
    return names;
}

std::string test_name(const testing::TestParamInfo<std::string>& parameter) {
    std::string name = parameter.param;
    std::replace_if(
        name.begin(), name.end(), [](unsigned char c) { return !std::isalnum(c); }, '_');
    return name;
}

class PublicCase : public testing::TestWithParam<std::string> {};

TEST_P(PublicCase, HasItsRightMean) {
    expect_right_mean(cases_folder() / (GetParam() + ".pbrt"));
}

INSTANTIATE_TEST_SUITE_P(SlowScenes, PublicCase, testing::ValuesIn(cases(cases_folder())), test_name);

/// What pbrt-v4 makes of what its format has: a feature each, by any preset.
class PbrtCase : public testing::TestWithParam<std::string> {};

TEST_P(PbrtCase, HasTheMeanOfPbrt) {
    for (const char* preset : {"classical", "full"}) {
        SCOPED_TRACE(preset);
        expect_right_mean(cases_folder() / "pbrt" / (GetParam() + ".pbrt"), preset);
    }
}

INSTANTIATE_TEST_SUITE_P(SlowScenes, PbrtCase, testing::ValuesIn(cases(cases_folder() / "pbrt")), test_name);

/// What Mitsuba 3 makes of what its format has: a feature each.
class MitsubaCase : public testing::TestWithParam<std::string> {};

TEST_P(MitsubaCase, HasTheMeanOfMitsuba) {
    expect_right_mean(cases_folder() / "mitsuba" / (GetParam() + ".xml"));
}

INSTANTIATE_TEST_SUITE_P(SlowScenes, MitsubaCase, testing::ValuesIn(cases(cases_folder() / "mitsuba", ".xml")),
                         test_name);

/// openvdb issue 1840 (rotated transforms), unreal-vdb issue 78 (negative scale in a file's transform).
TEST(PublicCases, AVolumeThatItsFileMirrorsAndTurns) {
    const test::ScratchFolder folder;
    // Index x >= 0 holds 3, x < 0 holds .5. The file mirrors x and turns it to the world's -y.
    openvdb::initialize();
    const auto grid = openvdb::FloatGrid::create(0.0f);
    grid->setName("density");
    auto voxels = grid->getAccessor();
    for (int x = -8; x < 8; ++x) {
        for (int y = -8; y < 8; ++y) {
            for (int z = -8; z < 8; ++z) {
                voxels.setValue({x, y, z}, x < 0 ? 0.5f : 3.0f);
            }
        }
    }
    constexpr double size = 0.125;
    grid->setTransform(openvdb::math::Transform::createLinearTransform(
        openvdb::Mat4d(0., -size, 0., 0., -size, 0., 0., 0., 0., 0., size, 0., 0., 0., 0., 1.)));  // row vectors
    openvdb::io::File(folder.file("ramp.vdb")).write({grid});

    const auto scene_from = [&](double y0, double y1, const std::string& right) {
        std::ostringstream text;
        text << "# Right mean: " << right << " %\n"
             << R"(Film "rgb" "integer xresolution" 12 "integer yresolution" 12
PixelFilter "box"
Sampler "sobol" "integer pixelsamples" 512
Integrator "volpath" "integer maxdepth" 100
LookAt 0 0 -8  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [ -0.3 0.3 )"
             << y0 << ' ' << y1 << R"( ]
WorldBegin
LightSource "infinite" "rgb L" [ 1 1 1 ]
MakeNamedMedium "m" "string type" "nanovdb" "string filename" "ramp.vdb" "rgb sigma_a" [ 0.2 0.5 1 ] "rgb sigma_s" [ 0 0 0 ]
Material "interface"
MediumInterface "m" ""
Shape "sphere" "float radius" 3
)";
        return folder.write("ramp.pbrt", text.str());
    };
    // Beer-Lambert over 15.5 voxels: the bounds of the file, from the least index to the largest plus one, cut half a
    // voxel of the field's border on one side.
    expect_right_mean(scene_from(-0.8, -0.2, "0.3127 0.0547 0.0030 within 2 2 10"));
    expect_right_mean(scene_from(0.2, 0.8, "0.8239 0.6161 0.3796 within 1"));
}

}  // namespace
}  // namespace wend
