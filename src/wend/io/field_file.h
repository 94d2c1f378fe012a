// Files of guiding fields: what a render learned, to look at or to go on with.
#pragma once

#include <wend/guide/fit.h>

#include <filesystem>

namespace wend {

/// Writes both fields of a render, and its notes. The file appears whole or not at all.
void write_fields(const std::filesystem::path& file, const guide::Fields& fields);

/// Reads them again, the same bit for bit. Throws InputError naming the file when it is missing, of another kind or
/// version, truncated or changed.
guide::Fields read_fields(const std::filesystem::path& file);

}  // namespace wend
