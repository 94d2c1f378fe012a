// Where tests find the project's own files, and the optional collection of real scenes beside it.
#pragma once

#include <filesystem>

namespace wend::test {

/// The root of the source tree.
std::filesystem::path source_dir();

/// The folder this build writes to: where failing tests leave what helps to understand them.
std::filesystem::path build_dir();

/// The folder of real scenes and reference values beside the checkout; tests that need it skip where it is absent.
std::filesystem::path shared_dir();

}  // namespace wend::test
