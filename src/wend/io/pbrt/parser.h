// Reads pbrt-v4 scene files (pbrt.org/fileformat-v4): the whole grammar, up to a description of what the scene consists
// of.
#pragma once

#include <wend/io/pbrt/description.h>

#include <filesystem>
#include <string>

namespace wend::pbrt {

struct ParseOptions {
    /// Whether Include and Import may open files; where they may not, they are errors.
    bool allow_includes = true;
};

/// Reads a scene file (plain or gzip) and the files it includes and imports. Throws InputError with file:line:column
/// for a missing or broken file, a syntax error, a directive in the wrong place, a parameter that is no parameter, a
/// singular transform, or a name that is not defined. Whether a type ("perspective") or a parameter is known is for the
/// reader of the description to say.
Description parse_file(const std::filesystem::path& file);

/// The same for a text; `name` stands for the file in messages, `base_directory` is where its Includes are looked up.
Description parse_string(std::string text, const std::filesystem::path& base_directory, std::string name,
                         const ParseOptions& options = {});

}  // namespace wend::pbrt
