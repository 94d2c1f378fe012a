#include <wend/io/png_check.h>

#include <wend/io/image_size.h>

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

namespace wend {
namespace {

constexpr std::string_view png_signature = "\x89PNG\r\n\x1a\n";
constexpr std::size_t empty_chunk = 12;  // bytes of its length, type and checksum

std::uint32_t big_endian(std::string_view bytes) {
    std::uint32_t value = 0;
    for (const char byte : bytes.substr(0, 4)) {
        value = value << 8 | static_cast<unsigned char>(byte);
    }
    return value;
}

struct Chunk {
    std::size_t begin;
    std::string_view type, data;

    std::size_t end() const { return begin + empty_chunk + data.size(); }
};

/// The chunk at a place; none where the file ends before.
std::optional<Chunk> chunk_at(std::string_view file, std::size_t begin) {
    if (begin > file.size() || file.size() - begin < empty_chunk) {
        return std::nullopt;
    }
    const std::uint32_t size = big_endian(file.substr(begin));
    if (file.size() - begin - empty_chunk < size) {
        return std::nullopt;
    }
    return Chunk{begin, file.substr(begin + 4, 4), file.substr(begin + 8, size)};
}

/// The most bytes that the rows unpack to. Interlaced ones come in seven pictures, with a byte before each row.
std::uint64_t unpacked_size(std::string_view header) {
    constexpr std::array<int, 7> samples{1, 0, 3, 1, 2, 0, 4};
    const std::uint64_t width = big_endian(header), height = big_endian(header.substr(4));
    const auto depth = static_cast<unsigned char>(header[8]), kind = static_cast<unsigned char>(header[9]);
    const std::uint64_t bits = kind < samples.size() ? static_cast<std::uint64_t>(samples[kind] * depth) : 0;
    return height * (width * bits / 8 + 2) * (header[12] == 0 ? 1 : 2) + 16;
}

/// stb says of what it does not take that it is no picture of a known kind.
void check_header(std::string_view header, std::size_t file_bytes, const Place& place) {
    check_image_size(big_endian(header), big_endian(header.substr(4)), file_bytes, place);
    const auto depth = static_cast<unsigned char>(header[8]), kind = static_cast<unsigned char>(header[9]);
    constexpr std::array<int, 5> depths{1, 2, 4, 8, 16}, kinds{0, 2, 3, 4, 6};
    if (std::find(depths.begin(), depths.end(), depth) == depths.end() ||
        std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
        throw InputError(
            place,
            fmt::format("the picture is damaged: PNG has no samples of {} bits in pixels of kind {}", depth, kind));
    }
}

/// Unpacks what chunks hold together, and keeps none of it.
class Unpacking {
public:
    Unpacking() : status_(inflateInit(&stream_)) {}
    ~Unpacking() { inflateEnd(&stream_); }
    Unpacking(const Unpacking&) = delete;
    Unpacking& operator=(const Unpacking&) = delete;

    /// Whether it is that many bytes at most so far. What is damaged ends; that is for the reader to find.
    bool is_at_most(std::string_view data, std::uint64_t most) {
        std::array<Bytef, 1 << 15> unpacked;
        stream_.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(data.data()));  // is only read from
        stream_.avail_in = static_cast<uInt>(data.size());
        do {
            stream_.next_out = unpacked.data();
            stream_.avail_out = unpacked.size();
            if (status_ == Z_OK) {
                status_ = inflate(&stream_, Z_NO_FLUSH);
                status_ = status_ == Z_BUF_ERROR ? Z_OK : status_;
            }
        } while (status_ == Z_OK && stream_.avail_out == 0 && stream_.total_out <= most);
        return stream_.total_out <= most;
    }

private:
    z_stream stream_{};
    int status_;
};

}  // namespace

void prepare_png(std::string& file, const Place& place) {
    if (!file.starts_with(png_signature)) {
        return;
    }
    std::uint64_t most = 0;
    Unpacking unpacking;
    std::vector<std::size_t> empty;
    for (auto chunk = chunk_at(file, png_signature.size());; chunk = chunk_at(file, chunk->end())) {
        if (!chunk) {
            // stb takes memory for what a chunk says that it holds.
            throw InputError(place, "the picture is truncated");
        }
        if (chunk->type == "IEND") {
            break;
        }
        if (chunk->type == "IHDR" && chunk->data.size() == 13) {
            check_header(chunk->data, file.size(), place);
            most = unpacked_size(chunk->data);
        } else if (chunk->type == "IDAT" && chunk->data.empty()) {
            empty.push_back(chunk->begin);
        } else if (chunk->type == "IDAT" && !unpacking.is_at_most(chunk->data, most)) {
            throw InputError(place, "the picture is damaged: it holds more pixels than its header says");
        } else if (chunk->type == "CgBI") {
            throw InputError(place, "the picture is a PNG file as only iPhones have it");
        }
    }
    if (!empty.empty()) {
        std::string kept;
        std::size_t from = 0;
        for (const std::size_t begin : empty) {
            kept.append(file, from, begin - from);
            from = begin + empty_chunk;
        }
        kept.append(file, from);
        file = std::move(kept);
    }
}

}  // namespace wend
