// The manual page.
#pragma once

#include <wend/app/command_tree.h>

#include <string>
#include <vector>

namespace wend {

/// wend(1) in the macros of man(7). `version` is what --version says.
std::string man_page(const std::vector<CommandShape>& tree, const std::string& version);

}  // namespace wend
