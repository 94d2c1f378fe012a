#pragma once

#include <wend/core/error.h>

#include <filesystem>
#include <string>

namespace wend::pbrt {

/// The whole of a text file, uncompressed if it is a gzip file (told by its first bytes, not by its name).
/// Throws InputError at `place` if the file is missing, unreadable, broken, or 2 GiB of text or more.
std::string read_text_file(const std::filesystem::path& file, const Place& place);

}  // namespace wend::pbrt
