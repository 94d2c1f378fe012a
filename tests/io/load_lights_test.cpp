#include "load_support.h"
#include "near.h"
#include "pbrt_support.h"

#include <wend/io/image_file.h>
#include <wend/io/spectrum/blackbody.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::expect_near_in_proportion;
using test::load_text;
using test::warnings_with;

template <class Kind>
Kind only_light(const std::string& world) {
    const LoadedScene loaded = load_text(world);
    EXPECT_EQ(loaded.scene.lights.size(), 1u) << world;
    return std::get<Kind>(loaded.scene.lights.at(0));
}

std::filesystem::path write_sky(const char* name, int width, int height, const Rgb& colour) {
    const auto file = std::filesystem::temp_directory_path() / name;
    Picture picture;
    picture.image = Image(width, height, colour);
    picture.full_size = {width, height};
    write_picture(file, picture);
    return file;
}

const std::string two_triangles =
    "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ] \"integer indices\" [ 0 1 2  0 2 3 ] ";

TEST(LoadLights, PointLight) {
    const auto light = only_light<PointLight>(
        "Translate 1 2 3 LightSource \"point\" \"rgb I\" [ 1 2 3 ] \"float scale\" 2 \"point3 from\" [ 0 0 1 ]");
    EXPECT_EQ(light.position, Vec3(1, 2, 4));
    expect_near_in_proportion(light.intensity, {2, 4, 6});
    const auto powered = only_light<PointLight>("LightSource \"point\" \"float power\" 10");
    expect_near_in_proportion(powered.intensity, Rgb(10 / (4 * pi)));
}

TEST(LoadLights, DistantLightComesFromFrom) {
    const auto light = only_light<DistantLight>(
        "LightSource \"distant\" \"point3 from\" [ 0 5 0 ] \"point3 to\" [ 0 0 0 ] \"rgb L\" [ 1 2 3 ]");
    EXPECT_NEAR(length(light.direction - Vec3(0, 1, 0)), 0, 1e-6f);
    expect_near_in_proportion(light.radiance, {1, 2, 3});
    EXPECT_NEAR(only_light<DistantLight>("LightSource \"distant\"").direction.z, -1, 1e-6f);
    const auto turned =
        only_light<DistantLight>("Rotate 90 1 0 0 LightSource \"distant\" \"float illuminance\" 50 \"float scale\" 2");
    EXPECT_NEAR(turned.direction.y, 1, 1e-6f);
    expect_near_in_proportion(turned.radiance, Rgb(100.0f));
    // With an angle it is a disk, and what is given is its irradiance.
    const auto sun = only_light<SkyDiskLight>("LightSource \"distant\" \"float angle\" 60 \"rgb L\" [ 1 2 3 ]");
    EXPECT_NEAR(sun.radiance.g, 2 / (pi * 0.25f), 1e-5f);
    EXPECT_NEAR(sun.one_minus_cosine, 1 - std::sqrt(0.75f), 1e-6f);
    only_light<DistantLight>("LightSource \"distant\" \"float angle\" 0");
    EXPECT_PRED2(contains, message_of([] { load_text("LightSource \"distant\" \"float angle\" 181"); }), "0 and 180");
    EXPECT_PRED2(contains, message_of([] { load_text("LightSource \"distant\" \"point3 to\" [ 0 0 0 ]"); }),
                 "must differ");
}

TEST(LoadLights, SpectraHaveLuminanceOne) {
    const auto black_body = only_light<DistantLight>("LightSource \"distant\" \"blackbody L\" 3000 \"float scale\" 4");
    EXPECT_NEAR(luminance(black_body.radiance), 4, 1e-3f);
    EXPECT_GT(black_body.radiance.r, black_body.radiance.b);
    const auto equal_energy = only_light<DistantLight>("LightSource \"distant\" \"spectrum L\" [ 300 7 900 7 ]");
    EXPECT_NEAR(luminance(equal_energy.radiance), 1, 1e-3f);
    expect_near_in_proportion(
        only_light<DistantLight>("LightSource \"distant\" \"spectrum L\" \"stdillum-D65\"").radiance, Rgb(1.0f), 0.01f);
}

TEST(LoadLights, InfiniteLights) {
    expect_near_in_proportion(
        only_light<UniformInfiniteLight>("LightSource \"infinite\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2").radiance,
        {2, 4, 6});
    expect_near_in_proportion(
        only_light<UniformInfiniteLight>("LightSource \"infinite\" \"float illuminance\" 3.14159265").radiance,
        Rgb(1.0f));
    EXPECT_TRUE(load_text("LightSource \"infinite\" \"rgb L\" [ 0 0 0 ]").scene.lights.empty());
}

TEST(LoadLights, BackdropsAreSeenOtherwiseThanTheyShine) {
    const auto shines = [](const Light& light) { return std::get<UniformInfiniteLight>(light).radiance.r; };
    const std::string sky = "LightSource \"infinite\" \"rgb L\" [ 2 2 2 ] \"string cameraview\" ";
    const SceneDescription shown = load_text(sky + "\"shown\"").scene;
    EXPECT_TRUE(shown.backdrops.empty());
    const SceneDescription hidden = load_text(sky + "\"hidden\"").scene;
    EXPECT_FLOAT_EQ(shines(hidden.lights.at(0)), 2);
    EXPECT_EQ(shines(hidden.backdrops.at(0).seen), 0);
    const SceneDescription only = load_text("LightSource \"point\" " + sky + "\"only\"").scene;
    EXPECT_EQ(shines(only.lights.at(1)), 0);
    EXPECT_FLOAT_EQ(shines(only.backdrops.at(0).seen), 2);
    EXPECT_EQ(only.backdrops.at(0).light, 1);
    EXPECT_PRED2(contains, message_of([&] { load_text(sky + "\"none\""); }), "known are shown, hidden, only");
}

TEST(LoadLights, PortalsAreInTheWorld) {
    // Seen from below: against the clock, and not where the light is translated to.
    const auto light = only_light<PortalInfiniteLight>(
        "Translate 9 9 9 LightSource \"infinite\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2 "
        "\"point3 portal\" [ 0 0 1  1 0 1  1 1 1  0 1 1 ]");
    EXPECT_TRUE(is_black(light.portal->radiance({0.5f, 0.5f, 0}, {0, 0, 1})));
    const auto turned = only_light<PortalInfiniteLight>(
        "Translate 9 9 9 LightSource \"infinite\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2 "
        "\"point3 portal\" [ 0 0 1  0 1 1  1 1 1  1 0 1 ]");
    expect_near_in_proportion(turned.portal->radiance({0.5f, 0.5f, 0}, {0, 0, 1}), {2, 4, 6});
    EXPECT_TRUE(is_black(turned.portal->radiance({1.5f, 0.5f, 0}, {0, 0, 1})));
    // Spectra have their own luminance there: a half of what is even, and a black body's with a peak of 1.
    const auto through = [](const std::string& radiance) {
        const auto portal = only_light<PortalInfiniteLight>("LightSource \"infinite\" " + radiance +
                                                            " \"point3 portal\" [ 0 0 1  0 1 1  1 1 1  1 0 1 ]");
        return luminance(portal.portal->radiance({0.5f, 0.5f, 0}, {0, 0, 1}));
    };
    EXPECT_NEAR(through("\"spectrum L\" [ 300 0.5 900 0.5 ]"), 0.5, 1e-3);
    EXPECT_NEAR(through("\"spectrum L\" \"stdillum-D65\""), 1, 1e-3);
    EXPECT_NEAR(through("\"blackbody L\" 3000"), luminance(blackbody_emission(3000)) / 106.857, 0.01);
    EXPECT_LT(through("\"blackbody L\" 3000"), 0.5);
    const auto message = [](const std::string& corners) {
        return message_of([&] { load_text("LightSource \"infinite\" \"point3 portal\" [ " + corners + " ]"); });
    };
    const LoadedScene skewed =
        load_text("LightSource \"infinite\" \"rgb L\" [1 2 3] \"point3 portal\" [ 0 0 1  0 1 1  1 1 1  1.1 0 1 ]");
    EXPECT_EQ(warnings_with(skewed, "not those of a rectangle"), 1);
    expect_near_in_proportion(environment_radiance(skewed.scene.lights.at(0), {0.5f, 0.5f, 0}, {0, 0, 1}), {1, 2, 3});
    EXPECT_PRED2(contains, message("0 0 0  1 0 0  1 1 0"), "4 corners, not 3");
    EXPECT_PRED2(contains, message("0 0 0  1 0 0  2 0 0  1 0 0"), "rectangle");
    EXPECT_PRED2(contains, message("0 0 0  0 0 0  1 1 0  0 1 0"), "rectangle");
}

TEST(LoadLights, SkyPictures) {
    const auto square = write_sky("wend_load_sky.exr", 16, 16, {1, 2, 3});
    const auto wide = write_sky("wend_load_wide.exr", 16, 8, {1, 2, 3});
    const auto light = only_light<ImageInfiniteLight>("LightSource \"infinite\" \"string filename\" \"" +
                                                      square.string() + "\" \"float scale\" 2");
    expect_near_in_proportion(light.mean_radiance(), {2, 4, 6});
    const auto lit = only_light<ImageInfiniteLight>("LightSource \"infinite\" \"string filename\" \"" +
                                                    square.string() + "\" \"float illuminance\" 5");
    // A uniform sky of luminance L has illuminance pi L; pbrt counts half of that in pictures.
    EXPECT_NEAR(luminance(lit.mean_radiance()), 5 * 2 / pi, 0.1f);
    EXPECT_PRED2(contains, message_of([&] {
                     load_text("LightSource \"infinite\" \"string filename\" \"" + wide.string() + "\"");
                 }),
                 "test.pbrt:3:24: error: the picture of an infinite light must be square");
    EXPECT_PRED2(
        contains, message_of([&] {
            load_text("LightSource \"infinite\" \"rgb L\" [ 1 1 1 ] \"string filename\" \"" + square.string() + "\"");
        }),
        "either");
}

/// Intensity of a light at a point towards a direction of any length.
template <class Kind>
Rgb shines(const Kind& light, const Vec3& w) {
    return intensity_towards(light, normalize(w));
}

TEST(LoadLights, SpotsShineFromAPointToAPoint) {
    const auto spot = only_light<SpotLight>(
        "Translate 0 0 5 LightSource \"spot\" \"rgb I\" [ 3 6 9 ] \"point3 from\" [ 1 0 0 ] \"point3 to\" [ 0 0 0 ] "
        "\"float coneangle\" 45 \"float conedeltaangle\" 15");
    EXPECT_EQ(spot.position, Vec3(1, 0, 5));
    expect_near_in_proportion(shines(spot, {-1, 0, 0}), {3, 6, 9});
    expect_near_in_proportion(shines(spot, {-1, 0.5f, 0}), {3, 6, 9});
    EXPECT_TRUE(is_black(shines(spot, {-1, 1.01f, 0})));
    EXPECT_TRUE(is_black(shines(spot, {1, 0, 0})));
    const auto powered = only_light<SpotLight>("LightSource \"spot\" \"float power\" 7 \"float coneangle\" 60");
    EXPECT_NEAR(light_power(powered, 0), 7, 1e-4f);
    const auto message = [](const std::string& parameters) {
        return message_of([&] { load_text("LightSource \"spot\" " + parameters); });
    };
    EXPECT_PRED2(contains, message("\"float coneangle\" 0"), "between 0 and 180");
    EXPECT_PRED2(contains, message("\"float conedeltaangle\" -1"), "not negative");
    EXPECT_PRED2(contains, message("\"point3 to\" [ 0 0 0 ]"), "must differ");
}

std::filesystem::path write_picture_of(const char* name, const Image& image) {
    const auto file = std::filesystem::temp_directory_path() / name;
    Picture picture;
    picture.image = image;
    picture.full_size = {image.width, image.height};
    write_picture(file, picture);
    return file;
}

TEST(LoadLights, GoniometricLightsHaveTheirPoleAlongY) {
    Image image(16, 16, Rgb(0.0f));
    for (int i = 6; i < 10; ++i) {
        for (int j = 6; j < 10; ++j) {
            image.at(i, j) = {1, 2, 3};
        }
    }
    const auto file = write_picture_of("wend_load_goniometric.exr", image);
    const std::string text = "LightSource \"goniometric\" \"string filename\" \"" + file.string() + "\"";
    const auto light =
        only_light<GoniometricLight>("Translate 1 2 3 " + text + " \"rgb I\" [ 2 1 0 ] \"float scale\" 5");
    EXPECT_EQ(light.position, Vec3(1, 2, 3));
    expect_near_in_proportion(shines(light, {0, 1, 0}), {20, 10, 0});
    EXPECT_TRUE(is_black(shines(light, {0, -1, 0})));
    const auto coloured = only_light<GoniometricLight>(text + " \"rgb I\" [ 2 1 0 ] \"bool coloured\" true");
    expect_near_in_proportion(shines(coloured, {0, 1, 0}), {2, 2, 0});
    EXPECT_NEAR(light_power(only_light<GoniometricLight>(text + " \"float power\" 3"), 0), 3, 1e-4f);
    EXPECT_PRED2(contains, message_of([] { load_text("LightSource \"goniometric\""); }), "filename");
}

TEST(LoadLights, ProjectorsThrowTheirPictureUpright) {
    Image image(4, 2, Rgb(0.0f));
    image.at(0, 0) = {8, 0, 0};
    image.at(3, 1) = {0, 0, 8};
    const auto file = write_picture_of("wend_load_projection.exr", image);
    const std::string text = "LightSource \"projection\" \"string filename\" \"" + file.string() + "\"";
    const auto light = only_light<ProjectionLight>(text + " \"float scale\" 2");
    // 90 degrees of the shorter side: the window is from (-2, -1) to (2, 1), its first row on top.
    expect_near_in_proportion(shines(light, {-1.9f, 0.9f, 1}), {16, 0, 0});
    expect_near_in_proportion(shines(light, {1.9f, -0.9f, 1}), {0, 0, 16});
    EXPECT_TRUE(is_black(shines(light, {-1.9f, -0.9f, 1})));
    EXPECT_TRUE(is_black(shines(light, {-1.9f, 1.1f, 1})));
    EXPECT_TRUE(is_black(shines(light, {1.9f, -0.9f, -1})));
    const auto powered = only_light<ProjectionLight>(text + " \"float power\" 3 \"float fov\" 40");
    EXPECT_NEAR(luminance(powered.intensity * spread(powered)), 3, 1e-3f);
    EXPECT_PRED2(contains, message_of([&] { load_text(text + " \"float fov\" 180"); }), "between 0 and 180");
}

TEST(LoadLights, UnknownLightsAreRefused) {
    EXPECT_PRED2(contains, message_of([] { load_text("LightSource \"laser\""); }), "known are distant");
    EXPECT_PRED2(contains, message_of([] { load_text("LightSource \"point\" \"rgb I\" [ 1 -1 1 ]"); }), "not negative");
}

TEST(LoadLights, EachTriangleIsALight) {
    const LoadedScene loaded = load_text("AttributeBegin AreaLightSource \"diffuse\" \"rgb L\" [ 5 6 7 ] " +
                                         two_triangles + "AttributeEnd Shape \"sphere\"");
    ASSERT_EQ(loaded.scene.lights.size(), 2u);
    EXPECT_EQ(loaded.scene.surfaces[0].first_light, 0);
    EXPECT_EQ(loaded.scene.surfaces[1].first_light, -1);
    for (const Light& light : loaded.scene.lights) {
        const auto& t = std::get<TriangleLight>(light);
        EXPECT_FLOAT_EQ(t.area, 0.5f);
        EXPECT_FLOAT_EQ(t.normal.z, 1);
        expect_near_in_proportion(t.radiance, {5, 6, 7});
        EXPECT_FALSE(t.two_sided);
    }
}

TEST(LoadLights, DegenerateTrianglesStayDarkAndKeepTheirNumber) {
    const LoadedScene loaded = load_text(
        "AreaLightSource \"diffuse\" Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ] "
        "\"integer indices\" [ 0 1 1  0 1 2 ]");
    ASSERT_EQ(loaded.scene.lights.size(), 2u);
    EXPECT_TRUE(is_black(std::get<TriangleLight>(loaded.scene.lights[0]).radiance));
    EXPECT_FALSE(is_black(std::get<TriangleLight>(loaded.scene.lights[1]).radiance));
    const Scene scene(
        load_text("AreaLightSource \"diffuse\" Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ] "
                  "\"integer indices\" [ 0 1 1  0 1 2 ]")
            .scene);
    const auto hit = scene.intersect({{0.7f, 0.3f, 1}, {0, 0, -1}});
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->light, 1);
}

TEST(LoadLights, EmissionFollowsTheOrientation) {
    // What a viewer above and below sees of an emitting shape.
    const auto seen = [](const std::string& world) {
        const Scene scene(load_text(world).scene);
        std::pair<float, float> above_and_below;
        for (const float side : {1.0f, -1.0f}) {
            const auto hit = scene.intersect({{0.3f, 0.2f, side * 5}, {0, 0, -side}});
            EXPECT_TRUE(hit);
            const Rgb radiance = emitted_radiance(scene.lights()[static_cast<std::size_t>(hit->light)], hit->normal,
                                                  hit->uv, {0, 0, side});
            (side > 0 ? above_and_below.first : above_and_below.second) = radiance.g;
        }
        return above_and_below;
    };
    using Sides = std::pair<float, float>;
    const std::string light = "AreaLightSource \"diffuse\" \"rgb L\" [ 2 2 2 ] ";
    EXPECT_EQ(seen(light + two_triangles), Sides(2, 0));
    EXPECT_EQ(seen(light + "ReverseOrientation " + two_triangles), Sides(0, 2));
    EXPECT_EQ(seen(light + "Scale 1 1 -1 " + two_triangles), Sides(0, 2));
    EXPECT_EQ(seen(light + two_triangles + "\"normal N\" [ 0 0 -1 0 0 -1 0 0 -1 0 0 -1 ]"), Sides(0, 2));
    EXPECT_EQ(seen(light + "Shape \"disk\""), Sides(2, 0));
    EXPECT_EQ(seen(light + "ReverseOrientation Shape \"disk\""), Sides(0, 2));
    EXPECT_EQ(seen(light + "Shape \"sphere\""), Sides(2, 2));
    EXPECT_EQ(seen(light + "ReverseOrientation Shape \"sphere\""), Sides(0, 0));
    EXPECT_EQ(seen("AreaLightSource \"diffuse\" \"rgb L\" [ 2 2 2 ] \"bool twosided\" true Shape \"disk\""),
              Sides(2, 2));
}

TEST(LoadLights, PowerIsThatOfEachShape) {
    const LoadedScene mesh = load_text("AreaLightSource \"diffuse\" \"float power\" 3 " + two_triangles);
    EXPECT_NEAR(std::get<TriangleLight>(mesh.scene.lights[0]).radiance.g * 0.5f * pi, 3, 1e-4f);
    const LoadedScene ball =
        load_text("Scale 3 3 3 AreaLightSource \"diffuse\" \"float power\" 3 \"bool twosided\" true Shape \"sphere\"");
    EXPECT_NEAR(std::get<QuadricLight>(ball.scene.lights[0]).radiance.g * 2 * 4 * pi * 9 * pi, 3, 1e-4f);
}

TEST(LoadLights, ShapesOfObjectsDoNotShine) {
    const LoadedScene loaded = load_text(
        "ObjectBegin \"lamp\" AreaLightSource \"diffuse\" Shape \"sphere\" ObjectEnd ObjectInstance \"lamp\"");
    EXPECT_TRUE(loaded.scene.lights.empty());
    EXPECT_EQ(warnings_with(loaded, "cannot be area lights"), 1);
}

TEST(LoadLights, AreaLightsShineByTheirPicture) {
    Image image(2, 2, Rgb(1.0f));
    image.at(0, 0) = Rgb(9.0f);
    const auto file = write_picture_of("wend_load_area.exr", image);
    const std::string text = "AreaLightSource \"diffuse\" \"string filename\" \"" + file.string() + "\" ";
    const LoadedScene loaded =
        load_text(text + "\"float scale\" 2 " + two_triangles + "\"point2 uv\" [ 0 0  1 0  1 1  0 1 ]");
    const Light& light = loaded.scene.lights.at(1);
    // The first row is where v is 1.
    expect_near_in_proportion(emitted_radiance(light, {0, 0, 1}, {0.1f, 0.9f}, {0, 0, 1}), Rgb(18.0f));
    expect_near_in_proportion(emitted_radiance(light, {0, 0, 1}, {0.1f, 0.1f}, {0, 0, 1}), Rgb(2.0f));
    EXPECT_TRUE(is_black(emitted_radiance(light, {0, 0, 1}, {0.1f, 0.9f}, {0, 0, -1})));
    Pcg32 random(1);
    for (int i = 0; i < 100; ++i) {
        const auto s = sample_light(light, {0.5f, 0.5f, 1}, random.uniform2(), random);
        ASSERT_TRUE(s);
        const Vec3 hit = Vec3(0.5f, 0.5f, 1) + s->direction * s->distance;
        expect_near_in_proportion(Rgb(s->uv.x, s->uv.y, 0), Rgb(hit.x, hit.y, 0), 1e-4f);
    }
    const LoadedScene disk = load_text(text + "\"float power\" 5 \"bool twosided\" true Shape \"disk\"");
    EXPECT_NEAR(light_power(disk.scene.lights.at(0), 0), 5, 1e-3f);
}

TEST(LoadLights, AllOfAPatchOrCylinderHasOnePower) {
    const auto power_of = [](const std::string& shape) {
        float sum = 0;
        for (const Light& light :
             load_text("AreaLightSource \"diffuse\" \"float power\" 3 Shape " + shape).scene.lights) {
            sum += light_power(light, 0);
        }
        return sum;
    };
    EXPECT_NEAR(power_of("\"bilinearmesh\" \"point3 P\" [ 0 0 0  1 0 0  0 1 0  1 1 0 ]"), 3, 1e-3f);
    EXPECT_NEAR(power_of("\"cylinder\""), 3, 1e-2f);
}

TEST(LoadLights, RoundLampsThatPbrtLightsOtherwiseAreNamed) {
    const auto warnings = [](const std::string& world) {
        return warnings_with(load_text("AreaLightSource \"diffuse\" " + world), "with an AreaLightSource");
    };
    EXPECT_EQ(warnings("Rotate 30 1 2 3 Translate 5 6 7 Shape \"sphere\" Shape \"disk\" Shape \"cylinder\""), 0);
    for (const std::string shape : {"\"sphere\"", "\"disk\"", "\"cylinder\""}) {
        EXPECT_EQ(warnings("Scale 1 1 2 Shape " + shape), 1) << shape;
        EXPECT_EQ(warnings("Scale -1 1 1 Shape " + shape), 0) << shape;
    }
    EXPECT_EQ(warnings("Shape \"sphere\" \"float zmax\" .5"), 1);
    EXPECT_EQ(warnings("Shape \"disk\" \"float innerradius\" .5"), 1);
    EXPECT_EQ(warnings("Shape \"disk\" \"float phimax\" 180"), 1);
    EXPECT_EQ(warnings("Scale 2 2 2 " + two_triangles), 0);
}

TEST(LoadLights, MirroredRoundLampsShineToTheSideOfTheUnmirroredOnes) {
    // Whether the lamp shines up to (0, 0, 3), by connections and where rays meet it.
    const auto shines = [](const std::string& world) {
        const Scene scene(load_text("AreaLightSource \"diffuse\" " + world).scene);
        const Vec3 above(0, 0, 3);
        const auto hit = scene.intersect({above, {0, 0, -1}});
        EXPECT_TRUE(hit) << world;
        const Light& light = scene.lights().at(static_cast<std::size_t>(hit->light));
        const bool seen = !is_black(emitted_radiance(light, hit->normal, hit->uv, {0, 0, 1}));
        Pcg32 random(1);
        int connected = 0;
        for (std::size_t i = 0; i < scene.lights().size(); ++i) {
            const auto s = sample_light(scene.lights()[i], above, {0.5f, 0.5f}, random);
            connected += s && !is_black(s->radiance);
        }
        // What is behind the near side of a cylinder is hidden, and may shine all the same.
        EXPECT_TRUE(seen ? connected > 0 : connected == 0 || scene.lights().size() > 1) << world;
        return seen;
    };
    for (const std::string shape : {"Shape \"sphere\"", "Shape \"disk\"", "Rotate 90 1 0 0 Shape \"cylinder\""}) {
        EXPECT_TRUE(shines(shape)) << shape;
        EXPECT_TRUE(shines("Scale -1 1 1 " + shape)) << shape;
        EXPECT_FALSE(shines("ReverseOrientation Scale -1 1 1 " + shape)) << shape;
    }
    // Surfaces that are no lamps keep pbrt's normals, and so do boundaries of media.
    const std::string fog = "MakeNamedMedium \"fog\" \"string type\" \"homogeneous\" MediumInterface \"fog\" \"\" ";
    EXPECT_TRUE(load_text("Scale -1 1 1 Shape \"sphere\"").scene.surfaces.at(0).flip_normal);
    EXPECT_TRUE(
        load_text(fog + "AreaLightSource \"diffuse\" Scale -1 1 1 Shape \"sphere\"").scene.surfaces.at(0).flip_normal);
    EXPECT_FALSE(
        load_text("AreaLightSource \"diffuse\" Scale -1 1 1 Shape \"sphere\"").scene.surfaces.at(0).flip_normal);
}

TEST(LoadLights, AlphaMakesLampsPartlyPresentOrUnseen) {
    const auto presence = [](const std::string& alpha) {
        return presence_of(load_text("AreaLightSource \"diffuse\" Shape \"sphere\" " + alpha).scene.lights.at(0));
    };
    EXPECT_EQ(presence(""), Presence::solid);
    EXPECT_EQ(presence("\"float alpha\" 1"), Presence::solid);
    EXPECT_EQ(presence("\"float alpha\" 0.5"), Presence::partly);
    EXPECT_EQ(presence("\"float alpha\" 0"), Presence::unseen);
    const Scene once(load_text("AreaLightSource \"diffuse\" \"bool alphaonce\" true "
                               "Shape \"sphere\" \"float alpha\" 0.5")
                         .scene);
    EXPECT_EQ(presence_of(once.lights().at(0)), Presence::once);
    EXPECT_EQ(once.presence(0, {{0.5f, 0.5f}, {}, {0, 0, 1}}), 0.5f);
    const Scene unseen(load_text("AreaLightSource \"diffuse\" Shape \"sphere\" \"float alpha\" 0").scene);
    EXPECT_TRUE(unseen.has_point_like_lights());
    EXPECT_EQ(unseen.presence(0, {{0, 0}, {0, 0, 1}}), 1);
    const Scene partly(load_text("AreaLightSource \"diffuse\" Shape \"sphere\" \"float alpha\" 0.25").scene);
    EXPECT_FALSE(partly.has_point_like_lights());
    EXPECT_EQ(partly.presence(0, {{0, 0}, {0, 0, 1}}), 0.25f);
}

TEST(LoadLights, AreaLightsShineByDirection) {
    const std::string sphere = "Rotate 90 1 0 0 Shape \"sphere\"";
    const auto cone = only_light<QuadricLight>(
        "AreaLightSource \"diffuse\" \"float coneangle\" 40 \"float conedeltaangle\" 10 " + sphere);
    ASSERT_TRUE(cone.profile);
    EXPECT_NEAR(cone.profile->axis.y, -1, 1e-6f) << "the axis is the shape's";
    EXPECT_NEAR(cone.profile->cos_inner, std::cos(30 * pi / 180), 1e-6f);
    const auto slats = only_light<QuadricLight>("AreaLightSource \"diffuse\" \"float spread\" 90 " + sphere);
    ASSERT_TRUE(slats.profile);
    EXPECT_NEAR(slats.profile->half_angle, pi / 4, 1e-6f);
    for (const auto& [given, said] :
         {std::pair("\"float spread\" 180", "\"spread\" must be from 0.5 to less than 180 degrees, not 180"),
          std::pair("\"float spread\" 20 \"float coneangle\" 20", "either \"coneangle\" or \"spread\""),
          std::pair("\"float coneangle\" -1", "\"coneangle\" must lie between 0 and 180")}) {
        EXPECT_PRED2(contains, message_of([&, given = given] {
                         load_text("AreaLightSource \"diffuse\" " + std::string(given) + " " + sphere);
                     }),
                     said);
    }
}

TEST(LoadLights, LampsThatAreNotSolidArePassed) {
    const std::string lamp = "AreaLightSource \"diffuse\" \"bool solid\" false ";
    const Scene scene(load_text("Material \"interface\" " + lamp + "Shape \"sphere\"").scene);
    ASSERT_EQ(scene.lights().size(), 1u);
    EXPECT_EQ(presence_of(scene.lights()[0]), Presence::passed);
    EXPECT_FALSE(scene.has_point_like_lights()) << "rays meet it";
    EXPECT_FALSE(scene.is_occluded(TracedRay(Ray{{0, 0, -5}, {0, 0, 1}}), 10));
    const std::optional<Hit> hit = scene.intersect(TracedRay(Ray{{0, 0, -5}, {0, 0, 1}}));
    ASSERT_TRUE(hit);
    EXPECT_EQ(hit->light, 0);
    EXPECT_TRUE(scene.is_interface(*hit));
    EXPECT_THROW(load_text(lamp + "Shape \"sphere\""), InputError) << "of another material";
}

TEST(LoadLights, InterfacesDoNotShine) {
    const LoadedScene loaded =
        load_text("Material \"interface\" AreaLightSource \"diffuse\" Shape \"sphere\" Shape \"disk\"");
    EXPECT_TRUE(loaded.scene.lights.empty());
    EXPECT_EQ(warnings_with(loaded, "warning: an AreaLightSource on a shape of \"interface\""), 1);
}

}  // namespace
}  // namespace wend
