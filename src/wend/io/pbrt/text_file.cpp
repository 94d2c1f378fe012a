#include <wend/io/pbrt/text_file.h>

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <limits>
#include <memory>

namespace wend::pbrt {
namespace {

constexpr std::size_t chunk = std::size_t{1} << 20;
constexpr std::size_t longest_text = std::numeric_limits<int>::max();

struct CloseFile {
    void operator()(gzFile file) const { gzclose_r(file); }
};

[[noreturn]] void fail(const std::filesystem::path& file, const Place& place, const std::string& reason) {
    throw InputError(place, fmt::format("cannot read \"{}\": {}", file.string(), reason));
}

}  // namespace

std::string read_text_file(const std::filesystem::path& file, const Place& place) {
    errno = 0;
    // zlib's reader passes files that are not gzip through unchanged.
    const std::unique_ptr<gzFile_s, CloseFile> input(gzopen(file.c_str(), "rb"));
    if (!input) {
        fail(file, place, std::strerror(errno));
    }
    gzbuffer(input.get(), chunk);

    std::string text;
    std::error_code unknown_size;
    const std::uintmax_t size = std::filesystem::file_size(file, unknown_size);
    if (!unknown_size && size < longest_text) {
        text.reserve(size + chunk);
    }
    constexpr std::uintmax_t base = std::uintmax_t{256} << 20, best_ratio = 64;
    const std::uintmax_t most = base + best_ratio * std::min<std::uintmax_t>(unknown_size ? 0 : size, longest_text);
    while (true) {
        const std::size_t used = text.size();
        text.resize(used + chunk);
        const int count = gzread(input.get(), text.data() + used, chunk);
        if (count < 0) {
            fail(file, place, errno != 0 ? std::strerror(errno) : "broken gzip data");
        }
        text.resize(used + static_cast<std::size_t>(count));
        if (text.size() >= longest_text) {
            fail(file, place, "the text is 2 GiB or more; keep large meshes in PLY files");
        }
        if (text.size() > most) {
            fail(file, place, fmt::format("it does not end within {} MiB", most >> 20));
        }
        if (count == 0) {
            break;
        }
    }
    int status = Z_OK;
    gzerror(input.get(), &status);
    if (status == Z_BUF_ERROR) {
        fail(file, place, "the gzip file is cut short");
    }
    return text;
}

}  // namespace wend::pbrt
