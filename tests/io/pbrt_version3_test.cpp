#include <tests/io/pbrt_support.h>
#include <wend/io/pbrt/parser.h>

#include <gtest/gtest.h>

#include <string>

namespace wend::pbrt {
namespace {

bool warns(const Description& d, const std::string& text) {
    for (const std::string& warning : d.warnings) {
        if (contains(warning, "a part of pbrt-v3") && contains(warning, text)) {
            return true;
        }
    }
    return false;
}

TEST(PbrtVersion3, OptionsHaveTheirNewNames) {
    const Description d = parse(
        "Film \"image\" \"float maxsampleluminance\" 10 \"float scale\" 2 PixelFilter \"gaussian\" \"float xwidth\" 3 "
        "\"float alpha\" 2 Sampler \"02sequence\" Integrator \"directlighting\" \"float rrthreshold\" .1 "
        "Camera \"environment\" WorldBegin WorldEnd");
    EXPECT_EQ(d.film.type, "rgb");
    EXPECT_EQ(d.film.parameters.get_float("maxcomponentvalue", 0), 10);
    EXPECT_EQ(d.film.parameters.get_float("iso", 0), 200);
    EXPECT_EQ(d.filter.parameters.get_float("xradius", 0), 3);
    EXPECT_EQ(d.filter.parameters.get_float("sigma", 0), .5f);
    EXPECT_EQ(d.sampler.type, "paddedsobol");
    EXPECT_EQ(d.integrator.type, "path");
    EXPECT_EQ(d.integrator.parameters.get_int("maxdepth", 0), 1);
    EXPECT_TRUE(d.integrator.parameters.has("maxdepth") && !d.integrator.parameters.has("rrthreshold"));
    EXPECT_EQ(d.camera.type, "spherical");
    EXPECT_TRUE(warns(d, "WorldEnd is not needed"));
    EXPECT_TRUE(warns(d, "\"image\" is read as \"rgb\""));
}

TEST(PbrtVersion3, Materials) {
    const Description d = parse_world(
        "Material \"matte\" \"color Kd\" [.1 .2 .3] Material \"glass\" \"float index\" 1.4 \"rgb Kr\" [1 1 1]\n"
        "Material \"plastic\" \"rgb Kd\" [.1 .2 .3] \"rgb Ks\" [0 0 0] \"float roughness\" .1 Material \"mirror\"\n"
        "Material \"mix\" \"rgb amount\" [.3 .3 .3] \"string namedmaterial1\" \"a\" \"string namedmaterial2\" \"b\"\n"
        "MakeNamedMaterial \"u\" \"string type\" \"uber\" \"rgb Kd\" [.1 .2 .3] \"float index\" 1.7");
    EXPECT_EQ(d.materials[1].type, "diffuse");
    EXPECT_EQ(std::get<RgbColour>(*d.materials[1].parameters.get_colour("reflectance")).value, Rgb(.1f, .2f, .3f));
    EXPECT_EQ(d.materials[2].type, "dielectric");
    EXPECT_EQ(d.materials[2].parameters.get_float("eta", 0), 1.4f);
    EXPECT_FALSE(d.materials[2].parameters.has("Kr"));
    EXPECT_EQ(d.materials[3].type, "diffuse");
    EXPECT_TRUE(d.materials[3].parameters.has("reflectance") && !d.materials[3].parameters.has("roughness"));
    EXPECT_EQ(d.materials[4].type, "conductor");
    EXPECT_TRUE(d.materials[4].parameters.has("eta") && d.materials[4].parameters.has("k"));
    EXPECT_EQ(d.materials[5].parameters.get_float("amount", 0), .3f);
    EXPECT_EQ(d.materials[5].parameters.get_strings("materials"), list<std::string>("b", "a"));
    EXPECT_EQ(d.materials[6].type, "coateddiffuse");
    EXPECT_EQ(d.materials[6].parameters.get_float("eta", 0), 1.7f);
    EXPECT_TRUE(warns(d, "\"matte\" is read as \"diffuse\""));
}

TEST(PbrtVersion3, LightsTexturesAndShapes) {
    const Description d = parse_world(
        "LightSource \"infinite\" \"string mapname\" \"a.exr\" \"rgb scale\" [2 2 2] \"rgb L\" [3 3 3]\n"
        "Texture \"a\" \"color\" \"imagemap\" \"bool trilinear\" true \"float gamma\" 2.2\n"
        "Texture \"b\" \"spectrum\" \"scale\" \"texture tex1\" \"a\" \"rgb tex2\" [.5 .5 .5]\n"
        "Texture \"c\" \"spectrum\" \"scale\" \"rgb tex1\" [.5 .5 .5] \"texture tex2\" \"a\"\n"
        "Shape \"loopsubdiv\" \"integer nlevels\" 2 \"point2 st\" [0 0]");
    EXPECT_EQ(d.lights[0].parameters.get_string("filename", ""), "a.exr");
    EXPECT_EQ(d.lights[0].parameters.get_float("scale", 0), 6);
    EXPECT_EQ(d.textures[0].kind, TextureKind::spectrum);
    EXPECT_EQ(d.textures[0].parameters.get_string("encoding", ""), "gamma 2.2");
    for (const int texture : {1, 2}) {
        EXPECT_EQ(d.textures[texture].parameters.get_texture("tex")->name, "a");
        EXPECT_EQ(d.textures[texture].parameters.get_float("scale", 0), .5f);
    }
    EXPECT_EQ(d.shapes[0].parameters.get_int("levels", 0), 2);
    EXPECT_TRUE(d.shapes[0].parameters.has("uv"));
}

TEST(PbrtVersion3, WhatChangedItsMeaningIsAnError) {
    const auto error = [](const std::string& text) { return message_of([&] { parse_world(text); }); };
    EXPECT_PRED2(contains, error("Shape \"heightfield\""), "t.pbrt:2:1: error: Shape \"heightfield\" is a part of");
    EXPECT_PRED2(contains, error("LightSource \"point\" \"rgb scale\" [1 2 3]"), "in pbrt-v4 a number");
    EXPECT_PRED2(
        contains,
        error("Texture \"a\" \"float\" \"constant\" Texture \"b\" \"spectrum\" \"scale\" \"texture tex1\" \"a\" "
              "\"texture tex2\" \"a\""),
        "the product of two textures");
}

TEST(PbrtVersion3, FilesOfVersion4StayAsTheyAre) {
    const Description d = parse_world(
        "Material \"diffuse\" Texture \"t\" \"spectrum\" \"scale\" \"float scale\" 2 LightSource \"point\" \"float "
        "scale\" "
        "3 Shape \"sphere\" \"float radius\" 2");
    EXPECT_TRUE(d.warnings.empty());
}

}  // namespace
}  // namespace wend::pbrt
