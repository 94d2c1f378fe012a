#pragma once

#include <cstddef>
#include <filesystem>
#include <string>

namespace wend {

/// The bytes of a file, unpacked if it is compressed by gzip, whatever its name. Throws InputError naming the file when
/// it is missing, unreadable or broken, or when it holds more than `max_bytes` unpacked, or more than 256 MiB and 64
/// times its size: what packs better, or never ends, is no input. Takes half as much memory again while it reads.
std::string read_file(const std::filesystem::path& file, std::size_t max_bytes = std::size_t{4} << 30);

}  // namespace wend
