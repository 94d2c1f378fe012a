// Reads Mitsuba 3's XML scenes (mitsuba.readthedocs.io) as descriptions in pbrt's terms.
#pragma once

#include <wend/io/pbrt/description.h>

#include <filesystem>
#include <string>

namespace wend::mitsuba {

/// Reads a scene file (plain or gzip), what it includes, and meshes and volumes. Colours are as in Mitsuba's RGB
/// variants. Throws InputError with file:line:column for a missing or broken file, and for what the scene asks for and
/// there is not; what Mitsuba has and Wend lacks is replaced or left out, and named in a warning, as are properties
/// that nobody asked for.
pbrt::Description read_scene(const std::filesystem::path& file);

/// The same for a text; `name` stands for the file in messages, `folder` is where its files are looked up.
/// `allow_includes`: whether `<include>` may open files.
pbrt::Description read_scene(const std::string& text, const std::filesystem::path& folder, const std::string& name,
                             bool allow_includes = true);

}  // namespace wend::mitsuba
