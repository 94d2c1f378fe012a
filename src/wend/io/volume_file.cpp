#include <wend/io/volume_file.h>

#include <wend/core/error.h>
#include <wend/io/nanovdb_file.h>
#include <wend/io/openvdb_file.h>

#include <fmt/ranges.h>

#include <array>
#include <fstream>
#include <string_view>
#include <vector>

namespace wend {
namespace {

/// A format: how its files begin, and who reads them.
struct VolumeFormat {
    std::string_view magic;
    std::optional<Volume> (*read)(const std::filesystem::path& file, const std::string& grid_name);
    std::vector<std::string> (*names)(const std::filesystem::path& file);
};

constexpr std::array<VolumeFormat, 2> volume_formats{
    {{nanovdb_magic, read_nanovdb, nanovdb_names}, {openvdb_magic, read_openvdb, openvdb_names}}};

const VolumeFormat& format_of(const std::filesystem::path& file) {
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw InputError(Place{file.string()}, "cannot open the volume");
    }
    std::array<char, 16> start{};
    stream.read(start.data(), start.size());
    for (const VolumeFormat& format : volume_formats) {
        if (std::string_view(start.data(), format.magic.size()) == format.magic) {
            return format;
        }
    }
    throw InputError(Place{file.string()}, "neither an OpenVDB nor a NanoVDB file");
}

}  // namespace

std::optional<Volume> try_read_volume(const std::filesystem::path& file, const std::string& grid_name) {
    try {
        return format_of(file).read(file, grid_name);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(Place{file.string()}, fmt::format("cannot read the volume: {}", error.what()));
    }
}

Volume read_volume(const std::filesystem::path& file, const std::string& grid_name) {
    std::optional<Volume> volume = try_read_volume(file, grid_name);
    if (!volume) {
        throw InputError(Place{file.string()}, fmt::format("has no grid `{}`, but: {}", grid_name,
                                                           fmt::join(format_of(file).names(file), ", ")));
    }
    return std::move(*volume);
}

}  // namespace wend
