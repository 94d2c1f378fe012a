// Files that hold a render on its way.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace wend {

/// What is known of the render, and all that it needs to go on.
struct Checkpoint {
    std::string description;  ///< JSON
    std::string state;        ///< what Render::save() wrote
};

/// Writes both, with a version and a checksum. The file appears whole or not at all. Throws std::runtime_error where
/// that fails; what was there before stays.
void write_checkpoint(const std::filesystem::path& file, std::string_view description, std::string_view state);

/// Reads it again. Throws InputError naming the file when it is missing, of another kind or version, truncated or
/// changed.
Checkpoint read_checkpoint(const std::filesystem::path& file);

}  // namespace wend
