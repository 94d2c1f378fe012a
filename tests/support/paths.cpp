#include "paths.h"

namespace wend::test {

std::filesystem::path source_dir() {
    return WEND_SOURCE_DIR;
}

std::filesystem::path build_dir() {
    return WEND_BUILD_DIR;
}

std::filesystem::path shared_dir() {
    return source_dir().parent_path() / "shared";
}

}  // namespace wend::test
