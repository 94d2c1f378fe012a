// OpenVDB files, through its library. Other modules use volume_file.h.
#pragma once

#include <wend/io/volume_file.h>

#include <string_view>
#include <vector>

namespace wend {

/// How every OpenVDB file begins.
inline constexpr std::string_view openvdb_magic = " BDV";

/// See try_read_volume. Exceptions of the library pass through.
std::optional<Volume> read_openvdb(const std::filesystem::path& file, const std::string& grid_name);
std::vector<std::string> openvdb_names(const std::filesystem::path& file);

}  // namespace wend
