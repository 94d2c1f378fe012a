#include "load_support.h"
#include "pbrt_support.h"

#include <wend/io/image_file.h>
#include <wend/io/spectrum/blackbody.h>

#include <gtest/gtest.h>

#include <cmath>

namespace wend {
namespace {

using pbrt::contains;
using pbrt::message_of;
using test::load_text;
using test::warnings_with;

template <class Kind>
Kind only_light(const std::string& world) {
    const LoadedScene loaded = load_text(world);
    EXPECT_EQ(loaded.scene.lights.size(), 1u) << world;
    return std::get<Kind>(loaded.scene.lights.at(0));
}

void expect_near(const Rgb& a, const Rgb& b, float tolerance = 1e-5f) {
    for (int c = 0; c < 3; ++c) {
        EXPECT_NEAR(a[c], b[c], tolerance * std::max(1.0f, std::abs(b[c])));
    }
}

std::filesystem::path write_sky(const char* name, int width, int height, const Rgb& colour) {
    const auto file = std::filesystem::temp_directory_path() / name;
    Picture picture;
    picture.image = Image(width, height, colour);
    picture.full_size = {width, height};
    write_picture(file, picture);
    return file;
}

TEST(LoadLights, PointLight) {
    const auto light = only_light<PointLight>(
        "Translate 1 2 3 LightSource \"point\" \"rgb I\" [ 1 2 3 ] \"float scale\" 2 \"point3 from\" [ 0 0 1 ]");
    EXPECT_EQ(light.position, Vec3(1, 2, 4));
    expect_near(light.intensity, {2, 4, 6});
    const auto powered = only_light<PointLight>("LightSource \"point\" \"float power\" 10");
    expect_near(powered.intensity, Rgb(10 / (4 * pi)));
}

TEST(LoadLights, DistantLightComesFromFrom) {
    const auto light = only_light<DistantLight>(
        "LightSource \"distant\" \"point3 from\" [ 0 5 0 ] \"point3 to\" [ 0 0 0 ] \"rgb L\" [ 1 2 3 ]");
    EXPECT_NEAR(length(light.direction - Vec3(0, 1, 0)), 0, 1e-6f);
    expect_near(light.radiance, {1, 2, 3});
    EXPECT_NEAR(only_light<DistantLight>("LightSource \"distant\"").direction.z, -1, 1e-6f);
    const auto turned =
        only_light<DistantLight>("Rotate 90 1 0 0 LightSource \"distant\" \"float illuminance\" 50 \"float scale\" 2");
    EXPECT_NEAR(turned.direction.y, 1, 1e-6f);
    expect_near(turned.radiance, Rgb(100.0f));
    EXPECT_PRED2(contains, message_of([] { load_text("LightSource \"distant\" \"point3 to\" [ 0 0 0 ]"); }),
                 "must differ");
}

TEST(LoadLights, SpectraHaveLuminanceOne) {
    const auto black_body = only_light<DistantLight>("LightSource \"distant\" \"blackbody L\" 3000 \"float scale\" 4");
    EXPECT_NEAR(luminance(black_body.radiance), 4, 1e-3f);
    EXPECT_GT(black_body.radiance.r, black_body.radiance.b);
    const auto equal_energy = only_light<DistantLight>("LightSource \"distant\" \"spectrum L\" [ 300 7 900 7 ]");
    EXPECT_NEAR(luminance(equal_energy.radiance), 1, 1e-3f);
    expect_near(only_light<DistantLight>("LightSource \"distant\" \"spectrum L\" \"stdillum-D65\"").radiance, Rgb(1.0f),
                0.01f);
}

TEST(LoadLights, InfiniteLights) {
    expect_near(
        only_light<UniformInfiniteLight>("LightSource \"infinite\" \"rgb L\" [ 1 2 3 ] \"float scale\" 2").radiance,
        {2, 4, 6});
    expect_near(only_light<UniformInfiniteLight>("LightSource \"infinite\" \"float illuminance\" 3.14159265").radiance,
                Rgb(1.0f));
    EXPECT_TRUE(load_text("LightSource \"infinite\" \"rgb L\" [ 0 0 0 ]").scene.lights.empty());
    const LoadedScene portal = load_text("LightSource \"infinite\" \"point3 portal\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ]");
    EXPECT_EQ(warnings_with(portal, "portals are ignored"), 1);
}

TEST(LoadLights, SkyPictures) {
    const auto square = write_sky("wend_load_sky.exr", 16, 16, {1, 2, 3});
    const auto wide = write_sky("wend_load_wide.exr", 16, 8, {1, 2, 3});
    const auto light = only_light<ImageInfiniteLight>("LightSource \"infinite\" \"string filename\" \"" +
                                                      square.string() + "\" \"float scale\" 2");
    expect_near(light.mean_radiance(), {2, 4, 6});
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

TEST(LoadLights, SubstitutesShineAsPoints) {
    const LoadedScene loaded = load_text(
        "LightSource \"spot\" \"rgb I\" [ 3 3 3 ] \"point3 from\" [ 1 0 0 ] \"point3 to\" [ 0 0 0 ] \"float "
        "coneangle\" 20");
    EXPECT_EQ(loaded.warnings.size(), 1u);
    expect_near(std::get<PointLight>(loaded.scene.lights.at(0)).intensity, Rgb(3.0f));
    EXPECT_PRED2(contains, message_of([] { load_text("LightSource \"laser\""); }), "known are distant");
    EXPECT_PRED2(contains, message_of([] { load_text("LightSource \"point\" \"rgb I\" [ 1 -1 1 ]"); }), "not negative");
}

const std::string two_triangles =
    "Shape \"trianglemesh\" \"point3 P\" [ 0 0 0  1 0 0  1 1 0  0 1 0 ] \"integer indices\" [ 0 1 2  0 2 3 ] ";

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
        expect_near(t.radiance, {5, 6, 7});
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
            const Rgb radiance =
                emitted_radiance(scene.lights()[static_cast<std::size_t>(hit->light)], hit->normal, hit->uv, {0, 0, side});
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

TEST(LoadLights, AreaLightPicturesBecomeTheirMean) {
    const auto picture = write_sky("wend_load_area.exr", 4, 2, {1, 2, 3});
    const LoadedScene loaded =
        load_text("AreaLightSource \"diffuse\" \"string filename\" \"" + picture.string() + "\" Shape \"disk\"");
    expect_near(std::get<QuadricLight>(loaded.scene.lights.at(0)).radiance, {1, 2, 3});
    EXPECT_EQ(warnings_with(loaded, "mean colour"), 1);
}

}  // namespace
}  // namespace wend
