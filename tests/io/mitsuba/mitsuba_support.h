// What the tests of the reader of Mitsuba scenes share.
#pragma once

#include "tests/io/pbrt_support.h"
#include "tests/support/scratch_folder.h"

#include <wend/io/mitsuba/reader.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace wend::mitsuba {

using pbrt::contains;
using pbrt::message_of;

/// A scene with a sensor and what else is given.
inline std::string scene_with(const std::string& content) {
    return "<scene version=\"3.0.0\">\n<sensor type=\"perspective\"><float name=\"fov\" value=\"40\"/></sensor>\n" +
           content + "\n</scene>\n";
}

/// What is wrong in a scene, and what is to be said of it.
struct Wrong {
    const char* content;
    const char* message;
};

/// A folder of files that scenes refer to.
class MitsubaFiles {
public:
    void write(const std::string& name, const std::string& text) const {
        std::ofstream(folder_.file(name), std::ios::binary) << text;
    }
    std::filesystem::path path(const std::string& name) const { return folder_.file(name); }
    pbrt::Description read(const std::string& content) const {
        write("scene.xml", scene_with(content));
        return read_scene(path("scene.xml"));
    }
    std::string error_of(const std::string& content) const {
        return message_of([&] { read(content); });
    }
    std::string error_of_text(const std::string& text) const {
        write("scene.xml", text);
        return message_of([&] { read_scene(path("scene.xml")); });
    }

private:
    test::ScratchFolder folder_;
};

/// All warnings, a line each.
inline std::string warnings_of(const pbrt::Description& scene) {
    std::string all;
    for (const std::string& warning : scene.warnings) {
        all += warning + "\n";
    }
    return all;
}

}  // namespace wend::mitsuba
