// By what a scene is known again: the content of all its files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace wend {

/// A file's name and what tells its content from others.
struct FileStamp {
    std::string name;  ///< relative to a folder
    std::uint64_t bytes = 0;
    std::uint32_t checksum = 0;  ///< CRC-32 of the bytes as they are stored

    friend bool operator==(const FileStamp&, const FileStamp&) = default;
};

/// A file's name in its stamp: relative to the folder, so that it stays the same where that is moved.
std::string stamp_name(const std::filesystem::path& file, const std::filesystem::path& folder);

/// Reads the file. Throws InputError where it cannot be read.
FileStamp stamp_of_file(const std::filesystem::path& file, std::string name);

/// Of bytes that are no file.
FileStamp stamp_of(std::string_view bytes, const std::string& name);

/// 16 hexadecimal digits for all of them.
std::string digest_of(std::span<const FileStamp> stamps);

}  // namespace wend
