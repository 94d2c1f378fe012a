#include "load_support.h"
#include "near.h"
#include "pbrt_support.h"

#include <wend/io/spectrum/white_balance.h>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::expect_near;
using test::load_text;
using test::warnings_with;

/// The pixels of a picture of this size.
Vec3 direction_at(const LoadedScene& loaded, float x, float y) {
    return loaded.scene.camera.ray({x, y}, {0.5f, 0.5f}).direction;
}

const std::string small_film = "Film \"rgb\" \"integer xresolution\" 200 \"integer yresolution\" 100\n";

TEST(LoadCamera, LooksAlongZWithYUpAndXToTheRight) {
    const LoadedScene loaded = load_text("", small_film + "Camera \"perspective\" \"float fov\" 90");
    expect_near(direction_at(loaded, 100, 50), {0, 0, 1});
    // The field of view is that of the shorter side, the height.
    expect_near(direction_at(loaded, 100, 0), normalize(Vec3(0, 1, 1)));
    expect_near(direction_at(loaded, 100, 100), normalize(Vec3(0, -1, 1)));
    expect_near(direction_at(loaded, 200, 50), normalize(Vec3(2, 0, 1)));
}

TEST(LoadCamera, TallPictureHasItsFieldOfViewAcross) {
    const LoadedScene loaded = load_text(
        "",
        "Film \"rgb\" \"integer xresolution\" 50 \"integer yresolution\" 100\nCamera \"perspective\" \"float fov\" 90");
    expect_near(direction_at(loaded, 50, 50), normalize(Vec3(1, 0, 1)));
    expect_near(direction_at(loaded, 25, 0), normalize(Vec3(0, 2, 1)));
}

TEST(LoadCamera, FollowsLookAtAndMirroring) {
    const LoadedScene plain = load_text("", small_film + "LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\"");
    expect_near(direction_at(plain, 100, 50), {0, 0, -1});
    // Left-handed as pbrt is: with y up and looking along -z, the picture's right is +x.
    EXPECT_GT(direction_at(plain, 150, 50).x * direction_at(plain, 50, 50).x, -1);
    const float right = direction_at(plain, 150, 50).x;
    const LoadedScene mirrored =
        load_text("", small_film + "Scale -1 1 1 LookAt 0 0 5  0 0 0  0 1 0 Camera \"perspective\"");
    EXPECT_NEAR(direction_at(mirrored, 150, 50).x, -right, 1e-6f);
    expect_near(plain.scene.camera.ray({100, 50}, {0, 0}).origin, {0, 0, 5});
}

TEST(LoadCamera, AnotherResolutionOfTheSameShapeSeesTheSame) {
    const std::string options = small_film + "Camera \"perspective\" \"float fov\" 60";
    const LoadedScene full = load_text("", options);
    const LoadedScene half = load_text("", options, {Vec2i(100, 50)});
    EXPECT_EQ(half.resolution, Vec2i(100, 50));
    expect_near(direction_at(full, 30, 20), direction_at(half, 15, 10));
    const LoadedScene square = load_text("", options, {Vec2i(100, 100)});
    expect_near(direction_at(square, 50, 0), direction_at(full, 100, 0));
    expect_near(direction_at(square, 100, 50), direction_at(full, 150, 50));
}

TEST(LoadCamera, ScreenWindowAndAspectOverrideTheShape) {
    const LoadedScene window =
        load_text("", small_film + "Camera \"perspective\" \"float fov\" 90 \"float screenwindow\" [ 0 1 -0.5 0 ]");
    expect_near(direction_at(window, 0, 0), {0, 0, 1});
    expect_near(direction_at(window, 200, 100), normalize(Vec3(1, -0.5f, 1)));
    const LoadedScene aspect =
        load_text("", small_film + "Camera \"perspective\" \"float fov\" 90 \"float frameaspectratio\" 1");
    expect_near(direction_at(aspect, 200, 50), normalize(Vec3(1, 0, 1)));
}

TEST(LoadCamera, Orthographic) {
    const LoadedScene loaded =
        load_text("", small_film + "Camera \"orthographic\" \"float screenwindow\" [ -10 10 -5 5 ]");
    const Ray ray = loaded.scene.camera.ray({200, 0}, {0.5f, 0.5f});
    expect_near(ray.origin, {10, 5, 0});
    expect_near(ray.direction, {0, 0, 1});
}

TEST(LoadCamera, SphericalMappings) {
    // Equirectangular: the upper edge looks up, the left edge along +x.
    const LoadedScene map = load_text("", small_film + "Camera \"spherical\" \"string mapping\" \"equirectangular\"");
    expect_near(direction_at(map, 100, 0), {0, 1, 0});
    expect_near(direction_at(map, 0, 50), {1, 0, 0});
    expect_near(direction_at(map, 50, 50), {0, 0, 1});
    // Equal area, the default: the middle looks up.
    const LoadedScene square =
        load_text("", "Film \"rgb\" \"integer xresolution\" 8 \"integer yresolution\" 8 Camera \"spherical\"");
    expect_near(direction_at(square, 4, 4), {0, 1, 0});
}

TEST(LoadCamera, Panoramas) {
    const auto load = [](const std::string& parameters) {
        return load_text("", small_film + "Camera \"panorama\" " + parameters);
    };
    // The whole sphere, its middle ahead.
    const LoadedScene sphere = load("");
    expect_near(direction_at(sphere, 100, 50), {0, 0, 1});
    expect_near(direction_at(sphere, 150, 50), {1, 0, 0});
    // The field of view is that of the shorter side.
    for (const char* mapping : {"equidistant", "equisolid"}) {
        const LoadedScene fisheye = load(fmt::format("\"string mapping\" \"{}\" \"float fov\" 120", mapping));
        expect_near(direction_at(fisheye, 100, 0), normalize(Vec3(0, std::sin(pi / 3), std::cos(pi / 3))));
        EXPECT_EQ(fisheye.scene.camera.ray({151, 50}, {0.5f, 0.5f}).weight, 0);
    }
    const LoadedScene polynomial = load(
        "\"string mapping\" \"polynomial\" \"float coefficients\" [ 0 0.1 ] \"float screenwindow\" [ -10 10 -5 5 ]");
    expect_near(direction_at(polynomial, 150, 50), {std::sin(0.5f), 0, std::cos(0.5f)});
}

TEST(LoadCamera, RefusesPanoramasWithoutAMeaning) {
    const auto message = [](const std::string& parameters) {
        return message_of([&] { load_text("", "Camera \"panorama\" \"string mapping\" " + parameters); });
    };
    EXPECT_PRED2(contains, message("\"mercator\""), "mapping \"mercator\" is unknown; known are cubeface");
    EXPECT_PRED2(contains, message("\"equidistant\" \"float fov\" 0"), "\"fov\" must lie above 0");
    EXPECT_PRED2(contains, message("\"equidistant\" \"float fov\" 1e30"), "\"fov\" must lie above 0");
    EXPECT_PRED2(contains, message("\"equisolid\" \"float fov\" 361"), "at most 360 degrees");
    EXPECT_PRED2(contains, message("\"polynomial\""), "one to five finite \"coefficients\"");
    EXPECT_PRED2(contains, message("\"polynomial\" \"float coefficients\" [ 0 1 ]"), "needs a \"screenwindow\"");
    EXPECT_PRED2(contains, message("\"cubeface\" \"float screenwindow\" [ -2 1 -1 1 ]"), "ends before pi / 2");
    EXPECT_PRED2(contains, message("\"mirrorball\" \"float lensradius\" -1"), "lensradius");
}

TEST(LoadCamera, StartsInItsMedium) {
    const std::string fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\"\n";
    const LoadedScene loaded = load_text("", fog + "MediumInterface \"\" \"fog\" Camera \"perspective\"");
    EXPECT_EQ(loaded.scene.camera_medium, 0);
    EXPECT_EQ(load_text("", "Camera \"perspective\"").scene.camera_medium, vacuum);
}

TEST(LoadCamera, APinholeMayBeFocusedAtNothing) {
    for (const std::string camera : {"Camera \"perspective\" ", "Camera \"orthographic\" "}) {
        EXPECT_TRUE(load_text("", camera + "\"float focaldistance\" 0").warnings.empty());
        EXPECT_PRED2(contains,
                     message_of([&] { load_text("", camera + "\"float focaldistance\" 0 \"float lensradius\" 1"); }),
                     "must be above 0");
    }
}

TEST(LoadCamera, ListsOfAnotherLengthAreIgnored) {
    const std::string film = "Film \"rgb\" \"integer xresolution\" 20 \"integer yresolution\" 10 ";
    const LoadedScene window = load_text("", film + "Camera \"orthographic\" \"float screenwindow\" [ -9 9 -9 9 1 ]");
    EXPECT_EQ(warnings_with(window, "\"screenwindow\" takes 4 values, not 5"), 1);
    EXPECT_EQ(window.scene.camera.ray({20, 10}, {0, 0}).origin, Vec3(2, -1, 0));
    const LoadedScene crop = load_text("", film + "\"float cropwindow\" [ 0 .5 ] \"integer pixelbounds\" [ 1 2 3 ]");
    EXPECT_EQ(warnings_with(crop, "it is ignored, as by pbrt"), 2);
    EXPECT_EQ(crop.crop, (PixelRect{{0, 0}, {20, 10}}));
}

TEST(LoadCamera, RefusesWhatIsWrongWithItsPlace) {
    const auto message = [](const std::string& camera) { return message_of([&] { load_text("", camera); }); };
    EXPECT_PRED2(contains, message("Camera \"perspective\" \"float fov\" 180"), "test.pbrt:1:22: error: \"fov\"");
    EXPECT_PRED2(contains, message("Camera \"frob\""),
                 "test.pbrt:1:1: error: Camera \"frob\" is unknown; known are perspective");
    EXPECT_PRED2(contains, message("Camera \"perspective\" \"float frameaspectratio\" 0"), "must be above 0");
    EXPECT_PRED2(contains, message("Camera \"spherical\" \"string mapping\" \"mercator\""), "mercator");
    EXPECT_PRED2(contains, message("Camera \"perspective\" \"float shutterclose\" 0"), "shutter");
}

/// A camera with a lens file of this text.
LoadedScene load_lenses(const std::string& lenses, const std::string& parameters = "") {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("wend_lenses_" + std::to_string(getpid()) + ".dat");
    std::ofstream(file) << lenses;
    const std::string camera = "Camera \"realistic\" \"string lensfile\" \"" + file.string() + "\" " + parameters;
    try {
        LoadedScene loaded = load_text("", small_film + camera);
        std::filesystem::remove(file);
        return loaded;
    } catch (...) {
        std::filesystem::remove(file);
        throw;
    }
}

const std::string some_lenses = "# a lens and a stop\n\n100 2 1.5 30\n-100 1 1 30 # air\n0 90 0 12\n";

/// The mean weight of the rays from the middle of the film.
double brightness(const LoadedScene& loaded) {
    constexpr int side = 200;
    double sum = 0;
    for (int i = 0; i < side * side; ++i) {
        const Vec2 lens((static_cast<float>(i % side) + 0.5f) / side, (static_cast<float>(i / side) + 0.5f) / side);
        sum += double{loaded.scene.camera.ray({100, 50}, lens).weight};
    }
    return sum / (side * side);
}

TEST(LoadCamera, RealisticIsFocusedAndStoppedDown) {
    const LoadedScene loaded = load_lenses(some_lenses, "\"float focusdistance\" 2 \"float aperturediameter\" 10");
    EXPECT_EQ(loaded.warnings.size(), 0u);
    // A stop 5 mm wide, seen from about 105 mm.
    EXPECT_NEAR(brightness(loaded), 3.1416 * 25 / (105 * 105), 0.03 * 3.1416 * 25 / (105 * 105));
    for (const char* aperture : {"gaussian", "square", "pentagon", "star"}) {
        const LoadedScene shaped =
            load_lenses(some_lenses, "\"float focusdistance\" 2 \"float aperturediameter\" 10 \"string aperture\" \"" +
                                         std::string(aperture) + "\"");
        EXPECT_EQ(shaped.warnings.size(), 0u);
        EXPECT_NEAR(brightness(shaped) / brightness(loaded), 1, 0.03) << aperture;
    }
    const LoadedScene wide = load_lenses(some_lenses, "\"float aperturediameter\" 13");
    EXPECT_EQ(warnings_with(wide, "\"aperturediameter\" is larger than the aperture of the lens file, 12"), 1);
}

TEST(LoadCamera, TheFilmOfRealisticHasADiagonal) {
    const auto angle = [](const char* film) {
        const LoadedScene loaded = load_lenses(some_lenses, std::string("\"float aperturediameter\" 1 Film \"rgb\" "
                                                                        "\"integer xresolution\" 200 \"integer "
                                                                        "yresolution\" 100 ") +
                                                                film);
        const Vec3 w = loaded.scene.camera.ray({200, 50}, {0.5f, 0.5f}).direction;
        return double{w.x / w.z};
    };
    // Half of the width over the distance of the film.
    EXPECT_NEAR(angle(""), 0.5 * 35 * 2 / std::sqrt(5.0) / 101, 0.01);
    EXPECT_NEAR(angle("\"float diagonal\" 70"), 35 * 2 / std::sqrt(5.0) / 101, 0.02);
}

TEST(LoadCamera, LensFilesAreCheckedByLine) {
    const auto message = [](const std::string& lenses, const std::string& parameters = "") {
        return message_of([&] { load_lenses(lenses, parameters); });
    };
    EXPECT_PRED2(contains, message("100 2 1.5 30\n-100 1 1\n"), ".dat:2:1: error: expected four numbers");
    EXPECT_PRED2(contains, message("100 2 1.5 thirty\n"), ".dat:1:1: error: expected four numbers");
    EXPECT_PRED2(contains, message("100 2 1.5 30 1\n"), ".dat:1:1: error: expected four numbers");
    EXPECT_PRED2(contains, message("#\n100 -2 1.5 30\n"), ".dat:2:1: error: a lens needs a thickness");
    EXPECT_PRED2(contains, message("10 2 1.5 30\n"), ".dat:1:1: error: the opening is wider than the ball");
    EXPECT_PRED2(contains, message("# nothing\n"), "test.pbrt:2:20: error: there are no lenses in");
    EXPECT_PRED2(contains, message(some_lenses, "\"float focusdistance\" .2"), "so near, nothing is in focus");
    EXPECT_PRED2(contains, message("-100 2 1.5 30\n100 50 1 30\n"), "the lenses do not collect light");
    EXPECT_PRED2(contains, message(some_lenses, "\"string aperture\" \"nowhere.png\""), "there is no file");
    EXPECT_PRED2(contains, message_of([] { load_text("", "Camera \"realistic\""); }),
                 "test.pbrt:1:1: error: \"realistic\" needs the parameter \"string lensfile\"");
}

TEST(LoadFilm, Defaults) {
    const LoadedScene loaded = load_text("");
    EXPECT_EQ(loaded.resolution, Vec2i(1280, 720));
    EXPECT_EQ(loaded.crop, (PixelRect{{0, 0}, {1280, 720}}));
    EXPECT_EQ(loaded.film_file, "pbrt.exr");
    EXPECT_EQ(loaded.exposure, 1);
    EXPECT_EQ(loaded.samples, 16);
    EXPECT_EQ(loaded.max_depth, 5);
    EXPECT_TRUE(loaded.scene.light_tree);
    EXPECT_EQ(loaded.sampler, SamplerKind::sobol);
    EXPECT_TRUE(loaded.warnings.empty());
}

TEST(LoadFilm, CropWindows) {
    const auto crop = [](const std::string& parameters, const LoadOverrides& overrides = {}) {
        return load_text("", "Film \"rgb\" \"integer xresolution\" 100 \"integer yresolution\" 50 " + parameters,
                         overrides)
            .crop;
    };
    EXPECT_EQ(crop("\"float cropwindow\" [ 0.25 0.5 0 1 ]"), (PixelRect{{25, 0}, {50, 50}}));
    EXPECT_EQ(crop("\"float cropwindow\" [ 0.5 0.25 0 1 ]"), (PixelRect{{25, 0}, {50, 50}}));
    EXPECT_EQ(crop("\"integer pixelbounds\" [ 10 20 5 600 ]"), (PixelRect{{10, 5}, {20, 50}}));
    EXPECT_EQ(crop("\"integer pixelbounds\" [ 10 20 5 600 ]", {Vec2i(200, 100)}), (PixelRect{{20, 10}, {40, 100}}));
    EXPECT_PRED2(contains, message_of([&] { crop("\"float cropwindow\" [ 0.5 0.5 0 1 ]"); }), "cropwindow");
    EXPECT_PRED2(contains, message_of([&] { crop("\"integer pixelbounds\" [ 200 300 0 9 ]"); }), "pixelbounds");
}

TEST(LoadFilm, ExposureFollowsSensitivityAndShutter) {
    EXPECT_FLOAT_EQ(load_text("", "Film \"rgb\" \"float iso\" 150").exposure, 1.5f);
    EXPECT_FLOAT_EQ(
        load_text("", "Film \"rgb\" \"float iso\" 200 Camera \"perspective\" \"float shutterclose\" 0.25").exposure,
        0.5f);
}

TEST(LoadFilm, NamesWhatItIgnores) {
    const LoadedScene loaded =
        load_text("",
                  "Film \"gbuffer\" \"string sensor\" \"canon_eos_5d\" \"float whitebalance\" 5000 "
                  "\"float maxcomponentvalue\" 10 \"bool savefp16\" false \"float frob\" 3");
    EXPECT_EQ(loaded.warnings.size(), 4u);
    for (const char* text :
         {"\"gbuffer\" is not implemented", "\"canon_eos_5d\"", "\"maxcomponentvalue\"", "\"frob\""}) {
        EXPECT_EQ(warnings_with(loaded, text), 1) << text;
    }
}

TEST(LoadFilm, BalancesWhite) {
    const auto balance = [](const std::string& film) { return load_text("", "Film \"rgb\" " + film).balance; };
    EXPECT_TRUE(balance("").is_identity());
    EXPECT_TRUE(balance("\"float whitebalance\" 0").is_identity());
    EXPECT_EQ(balance("\"float whitebalance\" 4000").m, white_balance(4000).m);
    // A measured sensor has a white of its own.
    EXPECT_EQ(balance("\"string sensor\" \"nikon_d850\"").m, sensor_balance(6500).m);
    EXPECT_EQ(balance("\"string sensor\" \"nikon_d850\" \"float whitebalance\" 5000").m, sensor_balance(5000).m);
    EXPECT_PRED2(contains, message_of([&] { balance("\"float whitebalance\" -5"); }),
                 "test.pbrt:1:12: error: the white of -5 K");
}

TEST(LoadFilm, SpectralFilmsNameWhatTheyLose) {
    const LoadedScene loaded =
        load_text("", "Film \"spectral\" \"integer nbuckets\" 8 \"float lambdamin\" 400 \"float lambdamax\" 700");
    EXPECT_EQ(loaded.warnings.size(), 1u);
    EXPECT_EQ(warnings_with(loaded, "no layers by wavelength"), 1);
}

TEST(LoadFilm, RefusesAbsurdSizes) {
    const auto message = [](const std::string& film) { return message_of([&] { load_text("", film); }); };
    EXPECT_PRED2(contains, message("Film \"rgb\" \"integer xresolution\" 1000000000"),
                 "test.pbrt:1:12: error: a picture of 1000000000 x 720");
    EXPECT_PRED2(contains, message("Film \"rgb\" \"integer yresolution\" 0"), "must be at least 1");
    EXPECT_PRED2(contains, message_of([] { load_text("", "", {Vec2i(1 << 20, 1 << 20)}); }), "too large");
}

TEST(LoadFilter, WeightsAverageToOneWithinTheRadius) {
    struct Case {
        const char* text;
        float radius;
    };
    for (const Case& c : {Case{"PixelFilter \"box\"", 0.5f},
                          {"PixelFilter \"triangle\"", 2},
                          {"PixelFilter \"gaussian\" \"float xradius\" 1 \"float yradius\" 1", 1},
                          {"PixelFilter \"mitchell\"", 2},
                          {"PixelFilter \"sinc\"", 4},
                          {"", 1.5f}}) {
        const LoadedScene loaded = load_text("", c.text);
        float furthest = 0;
        double sum = 0;
        constexpr int side = 64;
        for (int i = 0; i < side * side; ++i) {
            const auto s = loaded.filter.sample(
                {(static_cast<float>(i % side) + 0.5f) / side, (static_cast<float>(i / side) + 0.5f) / side});
            furthest = std::max(furthest, std::max(std::abs(s.offset.x), std::abs(s.offset.y)));
            sum += static_cast<double>(s.weight);
        }
        EXPECT_LE(furthest, c.radius) << c.text;
        EXPECT_GT(furthest, 0.5f * c.radius) << c.text;
        EXPECT_NEAR(sum / (side * side), 1, 0.05) << c.text;
    }
    EXPECT_TRUE(load_text("", "PixelFilter \"sinc\"").warnings.empty());
    EXPECT_PRED2(contains, message_of([] { load_text("", "PixelFilter \"box\" \"float xradius\" -1"); }), "above 0");
    EXPECT_PRED2(contains, message_of([] { load_text("", "PixelFilter \"box\" \"float xradius\" 1e9"); }),
                 "must not exceed");
}

TEST(LoadSampler, KindsSamplesAndSeeds) {
    const LoadedScene independent =
        load_text("", "Sampler \"independent\" \"integer pixelsamples\" 7 \"integer seed\" 3");
    EXPECT_EQ(independent.sampler, SamplerKind::independent);
    EXPECT_EQ(independent.samples, 7);
    EXPECT_EQ(independent.seed, 3u);
    const LoadedScene stratified =
        load_text("", "Option \"integer seed\" 5 Sampler \"stratified\" \"integer xsamples\" 3 \"bool jitter\" true");
    EXPECT_EQ(stratified.sampler, SamplerKind::sobol);
    EXPECT_EQ(stratified.samples, 12);
    EXPECT_EQ(stratified.seed, 5u);
    EXPECT_TRUE(stratified.warnings.empty());
    EXPECT_PRED2(contains, message_of([] { load_text("", "Sampler \"randomly\""); }), "known are halton");
    EXPECT_PRED2(contains, message_of([] { load_text("", "Sampler \"halton\" \"integer pixelsamples\" 0"); }),
                 "at least 1");
}

TEST(LoadIntegrator, OfSurfacesAloneLeavesOutMedia) {
    const std::string world =
        "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" MediumInterface \"fog\" \"\" "
        "Material \"dielectric\" Shape \"sphere\" Material \"subsurface\" Shape \"sphere\"";
    const std::string camera =
        "MakeNamedMedium \"air\" \"string type\" \"homogeneous\" MediumInterface \"\" \"air\" "
        "Camera \"perspective\" ";
    const LoadedScene seen = load_text(world, camera + "Integrator \"volpath\"");
    EXPECT_NE(seen.scene.camera_medium, vacuum);
    EXPECT_NE(seen.scene.surfaces.at(0).interior, vacuum);
    EXPECT_NE(seen.scene.surfaces.at(1).interior, vacuum);
    for (const char* integrator : {"path", "simplepath", "randomwalk"}) {
        const LoadedScene loaded = load_text(world, camera + "Integrator \"" + integrator + "\"");
        EXPECT_EQ(warnings_with(loaded, "leaves out all media"), 1);
        EXPECT_EQ(loaded.scene.camera_medium, vacuum);
        ASSERT_EQ(loaded.scene.surfaces.size(), 2u);
        for (const Surface& surface : loaded.scene.surfaces) {
            EXPECT_FALSE(surface.bounds_medium());
        }
    }
    EXPECT_EQ(load_text("Shape \"sphere\"", "Integrator \"path\"").warnings.size(), 0u);
}

TEST(LoadIntegrator, DepthLightsAndSubstitutes) {
    const LoadedScene loaded = load_text(
        "", "Integrator \"bdpt\" \"integer maxdepth\" 9 \"string lightsampler\" \"uniform\" \"bool regularize\" true");
    EXPECT_EQ(loaded.max_depth, 9);
    EXPECT_FALSE(loaded.scene.light_tree);
    EXPECT_EQ(loaded.warnings.size(), 3u);
    EXPECT_FALSE(load_text("", "Integrator \"path\" \"string lightsampler\" \"power\"").scene.light_tree);
    EXPECT_PRED2(contains, message_of([] { load_text("", "Integrator \"volpath\" \"integer maxdepth\" -1"); }),
                 "maxdepth");
    EXPECT_PRED2(contains, message_of([] { load_text("", "Integrator \"magic\""); }), "known are");
}

}  // namespace
}  // namespace wend
