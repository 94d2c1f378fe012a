// By what a scene is known again: the content of all its files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// A file's name and what tells its content from others.
struct FileStamp {
    std::string name;  ///< relative to a folder
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;  ///< CRC-32 of the bytes as they are stored

    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// Reads the files. Names are relative to the folder, so that they stay the same where that is moved. Throws InputError
/// for one that cannot be read.
std::vector<FileStamp> stamps_of(std::span<const std::filesystem::path> files, const std::filesystem::path& folder);

/// Of bytes that are no file.
FileStamp stamp_of(std::string_view bytes, const std::string& name);

/// 16 hexadecimal digits for all of them.
std::string digest_of(std::span<const FileStamp> stamps);

}  // namespace wend
