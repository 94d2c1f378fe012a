#include <wend/io/checkpoint_file.h>

#include <wend/io/atomic_file.h>
#include <wend/io/bytes.h>
#include <wend/io/gzip.h>

#include <zlib.h>

#include <cerrno>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <stdexcept>

namespace wend {
namespace {

constexpr std::string_view checkpoint_signature = "WENDCHECKPOINT\n";
constexpr std::uint32_t version = 11;

/// Bytes that go into a file one part after another, with the checksum of all.
class CheckedStream {
public:
    explicit CheckedStream(const std::filesystem::path& file) : stream_(file, std::ios::binary) {}

    void write(std::string_view bytes) {
        stream_.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
        checksum_ = crc32_z(checksum_, reinterpret_cast<const Bytef*>(bytes.data()), bytes.size());
    }
    template <class T>
    void write_number(T number) {
        write({reinterpret_cast<const char*>(&number), sizeof number});
    }
    /// False where anything failed.
    bool finish() {
        write_number(static_cast<std::uint32_t>(checksum_));
        stream_.close();
        return static_cast<bool>(stream_);
    }

private:
    std::ofstream stream_;
    uLong checksum_ = crc32_z(0, nullptr, 0);
};

}  // namespace

void write_checkpoint(const std::filesystem::path& file, std::string_view description, std::string_view state) {
    write_atomically(file, [&](const std::filesystem::path& temporary) {
        errno = 0;
        CheckedStream stream(temporary);
        stream.write(checkpoint_signature);
        stream.write_number(version);
        for (const std::string_view part : {description, state}) {
            stream.write_number(static_cast<std::uint64_t>(part.size()));
            stream.write(part);
        }
        if (!stream.finish()) {
            throw std::runtime_error(file.string() + ": cannot write: " + std::strerror(errno));
        }
    });
}

Checkpoint read_checkpoint(const std::filesystem::path& file) {
    const Place place{file.string()};
    constexpr std::size_t most = std::size_t{1} << 40;
    const std::string content = read_file(file, most);
    if (!std::string_view(content).starts_with(checkpoint_signature)) {
        throw InputError(place, "is no checkpoint");
    }
    Bytes bytes(content, place);
    bytes.seek(checkpoint_signature.size());
    if (const auto found = bytes.take<std::uint32_t>(); found != version) {
        throw InputError(place, "version " + std::to_string(found) + " of checkpoints is not known; this is version " +
                                    std::to_string(version));
    }
    Checkpoint checkpoint;
    checkpoint.description = bytes.take(bytes.take<std::uint64_t>());
    checkpoint.state = bytes.take(bytes.take<std::uint64_t>());
    const std::size_t end = content.size() - bytes.left();
    const auto checksum = bytes.take<std::uint32_t>();
    if (!bytes.empty() ||
        checksum != crc32_z(crc32_z(0, nullptr, 0), reinterpret_cast<const Bytef*>(content.data()), end)) {
        throw InputError(place, "the checksum does not fit: the file is truncated or was changed");
    }
    return checkpoint;
}

}  // namespace wend
