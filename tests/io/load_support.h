// What the tests of the scene loader share.
#pragma once

#include <wend/io/load/load_scene.h>
#include <wend/io/pbrt/parser.h>

#include <filesystem>
#include <string>
#include <utility>

namespace wend::test {

/// Loads a scene whose world (after WorldBegin) and options (before) are these.
inline LoadedScene load_text(const std::string& world, const std::string& options = "",
                             const LoadOverrides& overrides = {},
                             const std::filesystem::path& directory = std::filesystem::temp_directory_path()) {
    return load_scene(pbrt::parse_string(options + "\nWorldBegin\n" + world, directory, "test.pbrt"), overrides);
}

/// Whether one of the warnings holds this text, and how many do.
inline int warnings_with(const LoadedScene& loaded, const std::string& text) {
    int count = 0;
    for (const std::string& warning : loaded.warnings) {
        count += warning.find(text) != std::string::npos;
    }
    return count;
}

}  // namespace wend::test
