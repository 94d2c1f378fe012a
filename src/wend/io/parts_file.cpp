#include <wend/io/parts_file.h>

#include <wend/io/atomic_file.h>
#include <wend/io/bytes.h>
#include <wend/io/gzip.h>

#include <cstdint>

namespace wend {

void write_parts(const std::filesystem::path& file, std::string_view signature, std::span<const std::string> parts) {
    std::string out(signature);
    for (const std::string& part : parts) {
        const auto size = static_cast<std::uint64_t>(part.size());
        out.append(reinterpret_cast<const char*>(&size), sizeof size);
        out += part;
    }
    write_atomically(file, out);
}

PartsFile::PartsFile(const std::filesystem::path& file, std::string_view signature, std::size_t count,
                     const std::string& what, std::size_t optional)
    : place_{file.string(), 0, 0} {
    content_ = read_file(file);
    if (!std::string_view(content_).starts_with(signature)) {
        throw InputError(place_, "is no file of " + what);
    }
    Bytes bytes(content_, place_);
    bytes.seek(signature.size());
    for (std::size_t i = 0; i < count && !(i + optional >= count && bytes.empty()); ++i) {
        parts_.push_back(bytes.take(bytes.take<std::uint64_t>()));
    }
    if (!bytes.empty()) {
        throw InputError(place_, "has more in it than " + what);
    }
}

}  // namespace wend
