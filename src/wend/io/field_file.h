// Files of guiding fields: what a render learned, to look at or to go on with.
#pragma once

#include <wend/guide/fit.h>

#include <filesystem>
#include <string>

namespace wend {

/// Writes both fields of a render, its notes, and the digest of the scene that it learned in; empty: not known. The
/// file appears whole or not at all.
void write_fields(const std::filesystem::path& file, const guide::Fields& fields, const std::string& scene = {});

/// Reads them again, the same bit for bit. Throws InputError naming the file when it is missing, of another kind or
/// version, truncated or changed.
guide::Fields read_fields(const std::filesystem::path& file);

/// Fields, and where they come from.
struct SavedFields {
    guide::Fields fields;
    std::string scene;  ///< the digest that they were written with; empty where the file has none
};

/// As read_fields().
SavedFields read_saved_fields(const std::filesystem::path& file);

}  // namespace wend
