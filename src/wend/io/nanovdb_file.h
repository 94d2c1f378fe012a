// NanoVDB files. Other modules use volume_file.h.
#pragma once

#include <wend/io/volume_file.h>

#include <string_view>
#include <vector>

namespace wend {

/// How every NanoVDB file begins.
inline constexpr std::string_view nanovdb_magic = "NanoVDB0";

/// See try_read_volume.
std::optional<Volume> read_nanovdb(const std::filesystem::path& file, const std::string& grid_name);
std::vector<std::string> nanovdb_names(const std::filesystem::path& file);

}  // namespace wend
