#include <wend/io/gzip.h>

#include <wend/core/error.h>

#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <memory>

namespace wend {
namespace {

struct CloseGzip {
    void operator()(gzFile_s* file) const { gzclose(file); }
};

}  // namespace

std::string read_file(const std::filesystem::path& file, std::size_t max_bytes) {
    const Place place{file.string()};
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        throw InputError(place, "is a folder, not a file");
    }
    errno = 0;
    const std::unique_ptr<gzFile_s, CloseGzip> stream(gzopen(file.c_str(), "rb"));
    if (!stream) {
        throw InputError(place, std::string("cannot open: ") + std::strerror(errno));
    }
    // The size on disk is only a first guess: it is smaller than the content of a compressed file.
    const auto size = std::filesystem::file_size(file, ignored);
    constexpr std::uintmax_t base = std::uintmax_t{256} << 20, best_ratio = 64;
    const std::uintmax_t stored = ignored ? 0 : size;
    max_bytes = std::min<std::uintmax_t>(max_bytes, base + best_ratio * std::min<std::uintmax_t>(stored, max_bytes));
    std::size_t block = std::clamp<std::size_t>(stored + 1, 1u << 16, 1u << 30);
    std::string bytes;
    while (true) {
        const std::size_t before = bytes.size();
        bytes.resize(before + block);
        const int count = gzread(stream.get(), bytes.data() + before, static_cast<unsigned>(block));
        int error = Z_OK;
        const char* reason = gzerror(stream.get(), &error);
        if (count < 0 || (error != Z_OK && error != Z_STREAM_END)) {
            throw InputError(place, error == Z_BUF_ERROR ? "the compressed data is truncated"
                                                         : std::string("cannot read: ") +
                                                               (error == Z_ERRNO ? std::strerror(errno) : reason));
        }
        bytes.resize(before + static_cast<std::size_t>(count));
        if (bytes.size() > max_bytes) {
            throw InputError(place, "holds more than the " + std::to_string(max_bytes >> 20) + " MiB allowed");
        }
        if (static_cast<std::size_t>(count) < block) {
            return bytes;
        }
        // Up to one byte too many, by which that is told.
        block = std::min(std::clamp<std::size_t>(bytes.size(), 1u << 16, 1u << 30), max_bytes + 1 - bytes.size());
    }
}

}  // namespace wend
