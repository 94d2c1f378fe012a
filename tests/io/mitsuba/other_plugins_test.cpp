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
    add("bsdf", {"circular", "hair", "measured", "measured_polarized", "polarizer", "principledthin", "retarder"},
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

}  // namespace
}  // namespace wend::mitsuba
