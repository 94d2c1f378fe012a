#include "mitsuba_support.h"

#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace wend::mitsuba {
namespace {

std::string on_a_sphere(const std::string& inside) {
    return "<shape type=\"sphere\">" + inside + "</shape>";
}

std::string as_a_texture(const std::string& type) {
    return on_a_sphere("<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"" + type + "\"/></bsdf>");
}

std::string in_a_medium(const std::string& inside) {
    return on_a_sphere("<medium name=\"interior\" type=\"homogeneous\">" + inside + "</medium>");
}

/// What Mitsuba 3.9.1 has and is not read, by kind and type, and a scene with it.
struct Plugin {
    std::string title, content;
};

std::vector<Plugin> plugins() {
    std::vector<Plugin> all;
    const auto add = [&](const char* kind, const std::vector<const char*>& types, auto&& content) {
        for (const char* type : types) {
            all.push_back({std::string("<") + kind + " type=\"" + type + "\">", content(std::string(type))});
        }
    };
    const auto plain = [](const char* kind, const std::string& type) {
        return std::string("<") + kind + " type=\"" + type + "\"/>";
    };
    add("bsdf", {"measured_polarized"}, [&](const std::string& type) { return on_a_sphere(plain("bsdf", type)); });
    add("shape", {"ellipsoids", "ellipsoidsmesh", "sdfgrid"},
        [&](const std::string& type) { return plain("shape", type); });
    add("emitter", {"sunsky", "timed_sunsky", "volume"},
        [&](const std::string& type) { return plain("emitter", type); });
    add("emitter", {"directionalarea"}, [&](const std::string& type) { return on_a_sphere(plain("emitter", type)); });
    add("phase", {"sggx"}, [&](const std::string& type) { return in_a_medium(plain("phase", type)); });
    add("texture", {"volume"}, as_a_texture);
    add("spectrum", {"blackbody", "regular", "irregular"}, [](const std::string& type) {
        return on_a_sphere("<bsdf type=\"diffuse\"><spectrum name=\"reflectance\" type=\"" + type + "\"/></bsdf>");
    });
    return all;
}

/// What is said of it: why the scene is refused, or its warnings.
std::string said_of(const std::string& content) {
    std::string warnings;
    const std::string error =
        message_of([&] { warnings = warnings_of(read_scene(scene_with(content), "/tmp", "scene.xml")); });
    return error + warnings;
}

TEST(MitsubaPlugins, WhatIsNotReadStopsOrIsNamed) {
    for (const Plugin& plugin : plugins()) {
        EXPECT_PRED2(contains, said_of(plugin.content), plugin.title);
        EXPECT_PRED2(contains, said_of(plugin.content), "scene.xml:3:");
    }
    // What is read is not named.
    EXPECT_EQ(said_of(on_a_sphere("<bsdf type=\"diffuse\"/>")), "no error");
}

TEST(MitsubaPlugins, SkiesAreNamedWithHowToBakeThem) {
    const std::string said = said_of("<emitter type=\"sunsky\"/>");
    EXPECT_PRED2(contains, said, "\"python -m wend.mitsuba_sky scene.xml -o sky.exr\"");
    EXPECT_PRED2(contains, said, "<emitter type=\"envmap\"> and <emitter type=\"directional\"> take its place");
    EXPECT_PRED2(contains, said_of("<emitter type=\"timed_sunsky\"/>"), "<emitter type=\"sunsky\"> of one hour");
}

TEST(MitsubaPlugins, AttributesThatAMeshHasNotAreNamed) {
    const std::string texture =
        "<bsdf type=\"diffuse\"><texture name=\"reflectance\" type=\"mesh_attribute\">"
        "<string name=\"name\" value=\"vertex_color\"/></texture></bsdf>";
    EXPECT_PRED2(contains, said_of(on_a_sphere(texture)), "the shape has no attribute \"vertex_color\"; it has none");
    const MitsubaFiles files;
    files.write("m.ply",
                "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
                "property float heat_0\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
                "0 0 0 1\n1 0 0 2\n0 1 0 4\n3 0 1 2\n");
    const std::string shape = "<shape type=\"ply\"><string name=\"filename\" value=\"m.ply\"/>";
    EXPECT_PRED2(contains, files.error_of(shape + texture + "</shape>"), "it has vertex_heat");
    // Each mesh has its own, though the BSDF is one.
    const std::string shared =
        "<bsdf type=\"diffuse\" id=\"b\"><texture name=\"reflectance\" type=\"mesh_attribute\">"
        "<string name=\"name\" value=\"vertex_heat\"/><float name=\"scale\" value=\".1\"/>"
        "</texture></bsdf>";
    const pbrt::Description scene =
        files.read(shared + shape + "<ref id=\"b\"/></shape>" + shape + "<ref id=\"b\"/></shape>");
    ASSERT_EQ(scene.textures.size(), 3u) << "one tells a surface's sides apart";
    std::size_t meshes = 0;
    for (const auto& made : scene.textures) {
        if (made.type == "mesh") {
            ++meshes;
            EXPECT_EQ(made.parameters.get_floats("values"),
                      (std::vector<float>{.1f, .1f, .1f, .2f, .2f, .2f, .4f, .4f, .4f}));
            EXPECT_EQ(made.parameters.get_ints("indices"), (std::vector<int>{0, 1, 2}));
        }
    }
    EXPECT_EQ(meshes, 2u);
}

TEST(MitsubaPlugins, PolarizersAreGreyWithoutPolarization) {
    const auto alpha_of = [](const std::string& bsdf) {
        return read_scene(scene_with(on_a_sphere(bsdf)), "/tmp", "scene.xml")
            .shapes.at(0)
            .parameters.get_float("alpha", 1);
    };
    EXPECT_FLOAT_EQ(alpha_of("<bsdf type=\"polarizer\"/>"), 0.5f);
    EXPECT_FLOAT_EQ(alpha_of("<bsdf type=\"circular\"><rgb name=\"transmittance\" value=\".6\"/></bsdf>"), 0.7f);
    EXPECT_FLOAT_EQ(alpha_of("<bsdf type=\"retarder\"/>"), 0);
    EXPECT_PRED2(
        contains,
        said_of(on_a_sphere("<bsdf type=\"polarizer\"><rgb name=\"transmittance\" value=\".6 .5 .4\"/></bsdf>")),
        "the \"transmittance\" of <bsdf type=\"polarizer\"> is taken as grey");
}

/// Of a scene with this sensor alone.
std::string said_of_sensor(const std::string& sensor) {
    std::string warnings;
    const std::string error = message_of([&] {
        warnings = warnings_of(read_scene("<scene version=\"3.0.0\">\n" + sensor + "</scene>", "/tmp", "scene.xml"));
    });
    return error + warnings;
}

TEST(MitsubaPlugins, SensorsAndFilmsSayWhatStandsInForThem) {
    EXPECT_PRED2(contains, said_of_sensor("<sensor type=\"distant\"/>"),
                 "scene.xml:2:1: error: <sensor type=\"distant\"> is not implemented: an \"orthographic\" one");
    EXPECT_PRED2(contains, said_of_sensor("<sensor type=\"batch\"/>"), "give one of its sensors");
    EXPECT_PRED2(contains, said_of_sensor("<sensor type=\"irradiancemeter\"/>"), "a \"radiancemeter\" measures one");
    EXPECT_PRED2(contains, said_of_sensor("<shape type=\"cube\"><sensor type=\"irradiancemeter\"/></shape>"),
                 "scene.xml:2:20: error: a sensor on a shape is not implemented");
    EXPECT_PRED2(contains, said_of_sensor("<sensor type=\"frob\"/>"), "known are orthographic, perspective, radiance");
    EXPECT_PRED2(contains,
                 said_of_sensor("<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/>"
                                "<film type=\"specfilm\"/></sensor>"),
                 "<film type=\"specfilm\"> is for Mitsuba's spectral variants: \"hdrfilm\" takes its place");
}

TEST(MitsubaPlugins, RadiancemetersHaveOnePixelAndOneWay) {
    const auto said = [](const std::string& inside, const char* width = "1") {
        return said_of_sensor("<sensor type=\"radiancemeter\">" + inside +
                              "<film type=\"hdrfilm\"><integer name=\"width\" value=\"" + width +
                              "\"/><integer name=\"height\" value=\"1\"/></film></sensor>");
    };
    const std::string origin = "<point name=\"origin\" value=\"1 2 3\"/>";
    EXPECT_EQ(said(""), "no error");
    EXPECT_EQ(said(origin + "<vector name=\"direction\" value=\"0 0 2\"/>"), "no error");
    EXPECT_PRED2(contains, said("", "2"), "needs a film of 1 by 1 pixels");
    EXPECT_PRED2(contains, said(origin), "takes both an \"origin\" and a \"direction\"");
    EXPECT_PRED2(contains, said(origin + "<vector name=\"direction\" value=\"0 0 0\"/>"), "must not be 0");
}

}  // namespace
}  // namespace wend::mitsuba
