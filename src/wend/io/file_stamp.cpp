#include <wend/io/file_stamp.h>

#include <wend/core/error.h>
#include <wend/io/atomic_file.h>

#include <fmt/format.h>
#include <zlib.h>

#include <cerrno>
#include <cstring>
#include <fstream>
#include <utility>
#include <vector>

namespace wend {

std::string stamp_name(const std::filesystem::path& file, const std::filesystem::path& folder) {
    return file.lexically_proximate(folder).generic_string();
}

FileStamp stamp_of_file(const std::filesystem::path& file, std::string name) {
    if (is_device(file)) {
        throw InputError(Place{file.string()}, "is a pipe or a device, and a scene's files are read more than once");
    }
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw InputError(Place{file.string()}, std::string("cannot open: ") + std::strerror(errno));
    }
    FileStamp stamp{std::move(name)};
    std::vector<char> block(std::size_t{1} << 20);
    uLong checksum = crc32_z(0, nullptr, 0);
    while (stream) {
        stream.read(block.data(), static_cast<std::streamsize>(block.size()));
        const auto count = static_cast<std::size_t>(stream.gcount());
        checksum = crc32_z(checksum, reinterpret_cast<const Bytef*>(block.data()), count);
        stamp.bytes += count;
    }
    stamp.checksum = static_cast<std::uint32_t>(checksum);
    return stamp;
}

FileStamp stamp_of(std::string_view bytes, const std::string& name) {
    const uLong checksum = crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    return {name, bytes.size(), static_cast<std::uint32_t>(checksum)};
}

std::string digest_of(std::span<const FileStamp> stamps) {
    // FNV-1a.
    std::uint64_t digest = 0xcbf29ce484222325;
    for (const FileStamp& stamp : stamps) {
        for (const char c : fmt::format("{} {} {:08x}\n", stamp.name, stamp.bytes, stamp.checksum)) {
            digest = (digest ^ static_cast<unsigned char>(c)) * 0x100000001b3;
        }
    }
    return fmt::format("{:016x}", digest);
}

}  // namespace wend
