// Light that rays and connections must see alike.
#include <tests/support/channel_means.h>
#include <wend/io/load/load_scene.h>
#include <wend/io/pbrt/parser.h>
#include <wend/render/render.h>

#include <gtest/gtest.h>

#include <cmath>
#include <string>

namespace wend {
namespace {

const std::string head = R"(Film "rgb" "integer xresolution" 16 "integer yresolution" 12
Sampler "independent"
Integrator "volpath" "integer maxdepth" 12
)";

/// Means over eight renders of 256 samples each.
test::ChannelMeans rendered(const std::string& scene, const char* preset) {
    LoadedScene loaded = load_scene(pbrt::parse_string(head + scene, ".", "test.pbrt"));
    RenderSettings settings;
    settings.preset = parse_preset(preset);
    settings.samples = 256;
    settings.sampler = loaded.sampler;
    settings.max_depth = loaded.max_depth;
    settings.exposure = loaded.exposure;
    const Scene built(std::move(loaded.scene));
    test::ChannelMeans means;
    for (settings.seed = 1; settings.seed <= 8; ++settings.seed) {
        Film film(loaded.resolution, loaded.crop);
        render(built, film, settings);
        means.add(film.beauty());
    }
    return means;
}

void expect_the_same(const std::string& a, const char* preset_a, const std::string& b, const char* preset_b) {
    const test::ChannelMeans first = rendered(a, preset_a), second = rendered(b, preset_b);
    for (int c = 0; c < 3; ++c) {
        const double error = std::hypot(first[c].standard_error(), second[c].standard_error());
        EXPECT_NEAR(first[c].mean(), second[c].mean(), 4 * error)
            << preset_a << " and " << preset_b << ", channel " << c;
        // 3 % would be seen.
        EXPECT_LT(4 * error, 0.03 * first[c].mean());
    }
}

/// A room with a window, through which the sky shines, in a ball of hardly anything.
std::string room(bool has_ball) {
    const std::string medium = has_ball ? "MediumInterface \"\" \"air\"\n" : "";
    const std::string inside = has_ball ? "MediumInterface \"air\" \"air\"\n" : "";
    return R"(MakeNamedMedium "air" "string type" "homogeneous" "rgb sigma_s" [1e-6 1e-6 1e-6] "rgb sigma_a" [0 0 0]
)" + medium +
           R"(LookAt 0 0 5  0 0 0  0 1 0
Camera "perspective" "float fov" 40
WorldBegin
AttributeBegin
)" + inside +
           R"(Material "diffuse" "rgb reflectance" [0.7 0.6 0.5]
Shape "bilinearmesh" "point3 P" [-2 -1.5 -2  2 -1.5 -2  -2 -1.5 6  2 -1.5 6]
Shape "bilinearmesh" "point3 P" [-2 -1.5 -2  2 -1.5 -2  -2 2 -2  2 2 -2]
Shape "bilinearmesh" "point3 P" [-2 -1.5 -2  -2 -1.5 6  -2 2 -2  -2 2 6]
AttributeEnd
)" +
           (has_ball ? R"(AttributeBegin
MediumInterface "air" ""
Material "interface"
Shape "sphere" "float radius" 12
AttributeEnd
)"
                     : "") +
           R"(LightSource "infinite" "rgb L" [1 2 3] "point3 portal" [2 1.2 1.2  2 1.2 -1.2  2 -.7 -1.2  2 -.7 1.2]
)";
}

TEST(SlowFoundByBoth, APortalBeforeTheBoundaryOfAMedium) {
    expect_the_same(room(false), "classical", room(true), "classical");
    expect_the_same(room(true), "classical", room(true), "full");
}

TEST(SlowFoundByBoth, ALampThatIsThereByDirection) {
    const std::string scene = R"(LookAt 0 -4 2  0 0 .5  0 0 1
Camera "perspective" "float fov" 35
WorldBegin
Texture "one" "float" "constant" "float value" 1
Texture "little" "float" "constant" "float value" .1
Texture "tilted" "float" "directionmix" "texture tex1" "one" "texture tex2" "little" "vector3 dir" [0 0 1]
AttributeBegin
Translate 0 0 2.5
Rotate 180 1 0 0
AreaLightSource "diffuse" "rgb L" [6 5 4]
Shape "disk" "float radius" 1 "texture alpha" "tilted"
AttributeEnd
Material "conductor" "float roughness" .2
Shape "sphere" "float radius" .8
Material "diffuse"
Shape "trianglemesh" "integer indices" [0 1 2 2 3 0] "point3 P" [-4 -4 -1 4 -4 -1 4 4 -1 -4 4 -1]
)";
    expect_the_same(scene, "classical", scene, "full");
}

}  // namespace
}  // namespace wend
