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
    add("bsdf", {"circular", "measured", "measured_polarized", "polarizer", "principledthin", "retarder"},
        [&](const std::string& type) { return on_a_sphere(plain("bsdf", type)); });
    add("shape", {"ellipsoids", "ellipsoidsmesh", "sdfgrid"},
        [&](const std::string& type) { return plain("shape", type); });
    add("emitter", {"sunsky", "timed_sunsky", "volume"},
        [&](const std::string& type) { return plain("emitter", type); });
    add("emitter", {"directionalarea"}, [&](const std::string& type) { return on_a_sphere(plain("emitter", type)); });
    add("phase", {"sggx"}, [&](const std::string& type) { return in_a_medium(plain("phase", type)); });
    add("texture", {"mesh_attribute", "volume"}, as_a_texture);
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
