#pragma once

#include <wend/view/local_server.h>

#include <span>

namespace wend {

/// The page of the live view: the files of view/page, which the build makes a part of the program.
extern const std::span<const ServedFile> view_page;

}  // namespace wend
