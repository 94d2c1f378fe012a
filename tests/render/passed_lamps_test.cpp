// Lamps that rays see and pass, against lamps that only connections find: where no camera and no mirror sees them both
// light alike.
#include <tests/support/channel_means.h>
#include <tests/support/loaded_settings.h>
#include <wend/io/pbrt/parser.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cstdint>
#include <string>

namespace wend {
namespace {

/// A rough metal on a floor in a ball of fog, below a square and a sphere that shine, out of the camera's sight.
std::string foggy_metal(const std::string& lamp, const std::string& shape) {
    return fmt::format(R"(Film "rgb" "integer xresolution" 8 "integer yresolution" 8
Sampler "independent"
PixelFilter "box"
Integrator "volpath" "integer maxdepth" 12
LookAt 0 -3 1  0 0 .3  0 0 1
Camera "perspective" "float fov" 40
WorldBegin
MakeNamedMedium "fog" "string type" "homogeneous" "rgb sigma_s" [.6 .5 .4] "rgb sigma_a" [.05 .05 .05] "float g" .6
Material "diffuse" "rgb reflectance" [.6 .5 .4]
Shape "bilinearmesh" "point3 P" [-4 -4 0  4 -4 0  -4 4 0  4 4 0]
Material "conductor" "float roughness" .3
AttributeBegin
Translate 0 0 .4
Shape "sphere" "float radius" .4
AttributeEnd
AttributeBegin
{0}
AreaLightSource "diffuse" "rgb L" [6 4 2] {1}
Shape "bilinearmesh" "point3 P" [-1 -1 4  -1 1 4  1 -1 4  1 1 4] {2}
Translate 3 1 5
AreaLightSource "diffuse" "rgb L" [2 4 6] {1}
Shape "sphere" "float radius" .5 {2}
AttributeEnd
AttributeBegin
MediumInterface "fog" ""
Material "interface"
Shape "sphere" "float radius" 1.5
AttributeEnd
)",
                       lamp == "passed" ? "Material \"interface\"" : "", lamp == "passed" ? "\"bool solid\" false" : "",
                       shape);
}

Image render_once(const std::string& text, const char* preset, int samples, std::uint64_t seed) {
    LoadedScene loaded = load_scene(pbrt::parse_string(text, ".", "test.pbrt"));
    EXPECT_TRUE(loaded.warnings.empty()) << loaded.warnings[0];
    RenderSettings settings = test::settings_of(loaded, preset, samples);
    settings.seed = seed;
    const Scene scene(std::move(loaded.scene));
    Film film(loaded.resolution, loaded.crop);
    render(scene, film, settings);
    return film.beauty();
}

struct Row {
    const char* preset;
    int samples;
};

class PassedLampsSlow : public testing::TestWithParam<Row> {};

// At most half a million paths each.
TEST_P(PassedLampsSlow, LightAsThoseThatOnlyConnectionsFind) {
    const std::string unseen = foggy_metal("unseen", "\"float alpha\" 0"), passed = foggy_metal("passed", "");
    const auto expected = test::kept_means("unseen_lamps_in_fog", [&] {
        test::ChannelMeans means;
        for (std::uint64_t seed = 1; seed <= 16; ++seed) {
            means.add(render_once(unseen, "classical", 2048, 1000 + seed));
        }
        return means.known();
    });
    constexpr double bias = 0.01;
    const auto [preset, samples] = GetParam();
    const auto means = test::means_until_seen(bias, expected, (1 << 19) / (64 * samples), [&](std::uint64_t seed) {
        return render_once(passed, preset, samples, seed);
    });
    test::expect_known(means, expected, bias);
}

INSTANTIATE_TEST_SUITE_P(Slow, PassedLampsSlow,
                         testing::Values(Row{"classical", 16}, Row{"full", 1}, Row{"full", 4}, Row{"full", 16},
                                         Row{"full", 64}, Row{"full", 256}),
                         [](const auto& row) { return fmt::format("{}{}", row.param.preset, row.param.samples); });

// Behind a lamp that rays pass is what is there, undimmed.
TEST(PassedLamps, TheyAreSeenBeforeWhatIsBehind) {
    const std::string text = R"(Film "rgb" "integer xresolution" 4 "integer yresolution" 4
PixelFilter "box"
LookAt 0 0 5  0 0 0  0 1 0
Camera "orthographic" "float screenwindow" [-.5 .5 -.5 .5]
WorldBegin
LightSource "infinite" "rgb L" [1 2 3]
Material "interface"
AreaLightSource "diffuse" "rgb L" [4 4 4] "bool solid" false
Shape "bilinearmesh" "point3 P" [-1 -1 0  1 -1 0  -1 1 0  1 1 0]
)";
    for (const char* preset : {"classical", "full"}) {
        const Image picture = render_once(text, preset, 4, 1);
        for (const Rgb& pixel : picture.pixels) {
            for (int c = 0; c < 3; ++c) {
                EXPECT_NEAR(pixel[c], 5 + c, 1e-4) << preset;
            }
        }
    }
}

}  // namespace
}  // namespace wend
