#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace wend {

/// Makes a file appear whole or not at all: `write` fills a temporary file in the same folder, which then takes the
/// name `target`, replacing what was there. If anything fails the temporary is removed, `target` is untouched, and the
/// exception goes on: the one that `write` threw, or std::runtime_error.
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for content that is in memory.
void write_atomically(const std::filesystem::path& target, std::string_view content);

/// Tries whether write_atomically() can succeed, to ask before long work. Throws InputError, naming the reason, if not.
void require_writable(const std::filesystem::path& target);

}  // namespace wend
