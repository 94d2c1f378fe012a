// Scene files of any format as descriptions.
#pragma once

#include <wend/io/pbrt/description.h>

#include <filesystem>
#include <string>

namespace wend {

/// Reads a scene file: Mitsuba's XML where it is called `.xml` (or `.xml.gz`), pbrt-v4 otherwise. Throws InputError
/// with file:line:column for what is wrong in it.
pbrt::Description parse_scene(const std::filesystem::path& file);

/// The same for a text, which is XML where it begins with `<`; `name` stands for the file in messages, `folder` is
/// where its files are looked up.
pbrt::Description parse_scene(const std::string& text, const std::filesystem::path& folder, const std::string& name);

}  // namespace wend
