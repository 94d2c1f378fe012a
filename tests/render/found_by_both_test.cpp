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
Integrator "volpath" "integer maxdepth" 12
)";

/// Renders one scene.
class Renders {
public:
    explicit Renders(const std::string& scene)
        : Renders(load_scene(pbrt::parse_string(head + scene, ".", "test.pbrt"))) {}

    Image picture(const char* preset, int samples, std::uint64_t seed) {
        RenderSettings settings = settings_;
        settings.preset = parse_preset(preset);
        settings.samples = samples;
        settings.seed = seed;
        Film film(resolution_, crop_);
        render(scene_, film, settings);
        return film.beauty();
    }

private:
    explicit Renders(LoadedScene loaded)
        : resolution_(loaded.resolution), crop_(loaded.crop), scene_(std::move(loaded.scene)) {
        settings_.sampler = loaded.sampler;
        settings_.max_depth = loaded.max_depth;
        settings_.exposure = loaded.exposure;
    }

    Vec2i resolution_;
    PixelRect crop_;
    RenderSettings settings_;
    Scene scene_;
};

/// By classical walks.
std::vector<test::KnownMean> expected_of(const char* name, const std::string& scene) {
    return test::kept_means(name, [&] {
        Renders renders(scene);
        test::ChannelMeans means;
        for (std::uint64_t seed = 1000; seed < 1016; ++seed) {
            means.add(renders.picture("classical", 1024, seed));
        }
        return means.known();
    });
}

void expect_means(const std::string& scene, const char* preset, const std::vector<test::KnownMean>& expected) {
    SCOPED_TRACE(preset);
    Renders renders(scene);
    constexpr double bias = 0.03;
    test::expect_known(test::means_until_seen(bias, expected, 16,
                                              [&](std::uint64_t seed) { return renders.picture(preset, 256, seed); }),
                       expected, bias);
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
    // As it is without the medium.
    const auto expected = expected_of("portal", room(false));
    expect_means(room(true), "classical", expected);
    expect_means(room(true), "full", expected);
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
    expect_means(scene, "full", expected_of("directionmix", scene));
}

}  // namespace
}  // namespace wend
