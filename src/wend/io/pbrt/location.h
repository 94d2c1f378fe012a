#pragma once

#include <wend/core/error.h>

#include <filesystem>
#include <memory>
#include <string>

namespace wend::pbrt {

/// A scene file (or a text that stands for one): shared by all places in it.
struct SourceFile {
    std::string name;                 ///< as shown in messages
    std::filesystem::path directory;  ///< what file names written in it are relative to
};

/// A place in a scene file that is cheap to copy. Line and column count from 1; a column is a byte.
struct Location {
    std::shared_ptr<const SourceFile> file;
    int line = 0;
    int column = 0;

    /// So that `InputError(location, message)` reads well.
    operator Place() const { return {file ? file->name : std::string(), line, column}; }
};

}  // namespace wend::pbrt
