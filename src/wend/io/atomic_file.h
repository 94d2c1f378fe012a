#pragma once

#include <filesystem>
#include <functional>
#include <string_view>

namespace wend {

/// Makes a file appear whole or not at all: `write` fills a temporary file in the same folder, which then takes the
/// name `target`, replacing what was there, with its mode. A symbolic link stays, and what it leads to is replaced.
/// What is there but is no file (a device, a pipe) is written to instead. If anything fails the temporary is removed,
/// `target` is untouched, and the exception goes on: the one that `write` threw, or std::runtime_error.
void write_atomically(const std::filesystem::path& target,
                      const std::function<void(const std::filesystem::path& temporary)>& write);

/// The same for content that is in memory.
void write_atomically(const std::filesystem::path& target, std::string_view content);

/// Tries whether write_atomically() can succeed, to ask before long work. Throws InputError, naming the reason, if not.
void require_writable(const std::filesystem::path& target);

/// Removes what write_atomically() has not finished, in any thread, for a program that is about to end. May be called
/// from a signal handler.
void remove_unfinished_files() noexcept;

/// Whether there is something of that name that is neither a file nor a folder, so that writing replaces nothing.
bool is_device(const std::filesystem::path& target);

/// Where links lead to, as far as there are any.
std::filesystem::path behind_links(const std::filesystem::path& target);

}  // namespace wend
