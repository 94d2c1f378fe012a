// Where tests find the project's own files, and the optional collection of real scenes beside it.
#pragma once

#include <filesystem>

namespace wend::test {

/// The root of the source tree.
inline std::filesystem::path source_dir() {
    return WEND_SOURCE_DIR;
}

/// The folder this build writes to: where failing tests leave what helps to understand them.
inline std::filesystem::path build_dir() {
    return WEND_BUILD_DIR;
}

/// The folder of real scenes and reference values beside the checkout; tests that need it skip where it is absent.
inline std::filesystem::path shared_dir() {
    return source_dir().parent_path() / "shared";
}

}  // namespace wend::test
