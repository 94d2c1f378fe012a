// Completion of the command line by shells.
#pragma once

#include <wend/app/command_tree.h>

#include <string>
#include <vector>

namespace wend {

/// Scripts that complete subcommands, options, values where they are known, and file names elsewhere.
std::string bash_completion(const std::vector<CommandShape>& tree);
std::string zsh_completion(const std::vector<CommandShape>& tree);
std::string fish_completion(const std::vector<CommandShape>& tree);

}  // namespace wend
