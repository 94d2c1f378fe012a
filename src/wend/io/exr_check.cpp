#include <wend/io/exr_check.h>

#include <wend/core/error.h>
#include <wend/io/atomic_file.h>
#include <wend/io/image_size.h>

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfHeader.h>
#include <fmt/format.h>

#include <array>
#include <cerrno>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>
#include <utility>

namespace wend {
namespace {

// More numbers than this in all channels together are refused, and in the lines that are unpacked at once.
constexpr std::int64_t max_values = std::int64_t{1} << 30;
constexpr std::int64_t max_values_at_once = std::int64_t{1} << 27;

// Of the version: each of many parts has a header, and an empty one ends them.
constexpr std::uint32_t many_parts = 0x1000;

int lines_at_once(Imf::Compression compression) {
    switch (compression) {
        case Imf::ZIP_COMPRESSION:
        case Imf::PXR24_COMPRESSION:
            return 16;
        case Imf::PIZ_COMPRESSION:
        case Imf::B44_COMPRESSION:
        case Imf::B44A_COMPRESSION:
        case Imf::DWAA_COMPRESSION:
            return 32;
        case Imf::DWAB_COMPRESSION:
            return 256;
        default:
            return 1;
    }
}

/// Whether an attribute holds what its type says: the library reads that, and goes on behind it whatever the size is.
bool is_of_its_size(std::string_view type, std::string_view value) {
    constexpr std::array<std::pair<std::string_view, std::size_t>, 24> sizes{{{"box2f", 16},
                                                                              {"box2i", 16},
                                                                              {"chromaticities", 32},
                                                                              {"compression", 1},
                                                                              {"deepImageState", 1},
                                                                              {"double", 8},
                                                                              {"envmap", 1},
                                                                              {"float", 4},
                                                                              {"int", 4},
                                                                              {"keycode", 28},
                                                                              {"lineOrder", 1},
                                                                              {"m33d", 72},
                                                                              {"m33f", 36},
                                                                              {"m44d", 128},
                                                                              {"m44f", 64},
                                                                              {"rational", 8},
                                                                              {"tiledesc", 9},
                                                                              {"timecode", 8},
                                                                              {"v2d", 16},
                                                                              {"v2f", 8},
                                                                              {"v2i", 8},
                                                                              {"v3d", 24},
                                                                              {"v3f", 12},
                                                                              {"v3i", 12}}};
    for (const auto& [known, size] : sizes) {
        if (type == known) {
            return value.size() == size;
        }
    }
    const auto number = [&value](std::size_t at) {
        std::uint32_t n = 0;
        std::memcpy(&n, value.data() + at, sizeof n);
        return std::uint64_t{n};
    };
    if (type == "preview") {
        return value.size() >= 8 && number(0) < (1u << 16) && number(4) < (1u << 16) &&
               value.size() == 8 + 4 * number(0) * number(4);
    }
    if (type == "stringvector") {
        while (value.size() >= sizeof(std::uint32_t) && number(0) <= value.size() - sizeof(std::uint32_t)) {
            value.remove_prefix(sizeof(std::uint32_t) + number(0));
        }
        return value.empty();
    }
    if (type == "chlist") {
        constexpr std::size_t channel = 16;
        while (!value.empty() && value.front() != 0) {
            const std::size_t name = value.find('\0');
            if (name == std::string_view::npos || value.size() - name - 1 < channel) {
                return false;
            }
            value.remove_prefix(name + 1 + channel);
        }
        return value.size() == 1;
    }
    return true;
}

/// What the parts of a file say that they hold, all together.
class Sizes {
public:
    Sizes(std::uintmax_t file_bytes, const Place& place) : file_bytes_(file_bytes), place_(place) {}

    /// Throws InputError where that is too much.
    void add(const Imf::Header& header) {
        const Imath::Box2i& window = header.dataWindow();
        const std::int64_t width = std::int64_t{window.max.x} - window.min.x + 1;
        const std::int64_t height = std::int64_t{window.max.y} - window.min.y + 1;
        check_image_size(width, height, file_bytes_, place_);
        std::int64_t channels = 0;
        for (auto channel = header.channels().begin(); channel != header.channels().end(); ++channel) {
            ++channels;
        }
        values_ += width * height * channels;
        pixels_ += width * height;
        if (values_ > max_values || width * lines_at_once(header.compression()) * channels > max_values_at_once) {
            throw InputError(place_, fmt::format("the picture is too large: {} x {} pixels of {} channels{}", width,
                                                 height, channels, is_first_ ? "" : " in one of its parts"));
        }
        // The library keeps where each line or tile is, as the file does.
        if (!is_credible_size(pixels_, file_bytes_) ||
            (header.hasChunkCount() && header.chunkCount() > static_cast<std::int64_t>(file_bytes_ / 8))) {
            throw InputError(place_, "the picture is truncated: it is too short for its parts");
        }
        is_first_ = false;
    }

private:
    std::uintmax_t file_bytes_;
    const Place& place_;
    std::int64_t values_ = 0, pixels_ = 0;
    bool is_first_ = true;
};

}  // namespace

void check_exr_attributes(const std::filesystem::path& file, const Place& place) {
    constexpr std::streamoff bytes_before_header = 8;
    constexpr std::size_t longest_name = 255;
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {
        throw InputError(place, "is a folder, not a file");
    }
    if (is_device(file)) {
        throw InputError(place, "is a pipe or a device, and OpenEXR pictures are not read in order");
    }
    errno = 0;
    std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw InputError(place, std::string("cannot open: ") + std::strerror(errno));
    }
    std::uint32_t start[2] = {0, 0};  // the magic number and the version, with flags
    stream.read(reinterpret_cast<char*>(start), bytes_before_header);
    constexpr std::uint32_t magic = 20000630;
    if (stream && start[0] != magic) {
        throw InputError(place, "not an OpenEXR picture");
    }
    auto left = static_cast<std::int64_t>(std::filesystem::file_size(file)) - bytes_before_header;
    const auto take_name = [&] {
        std::string name;
        for (int c = stream.get(); c > 0 && name.size() <= longest_name; c = stream.get()) {
            name += static_cast<char>(c);
        }
        left -= static_cast<std::int64_t>(name.size()) + 1;
        if (name.size() > longest_name) {
            throw InputError(place, "the picture is damaged: an attribute's name does not end");
        }
        return name;
    };
    int attributes = 0;
    for (bool ends = false; !ends;) {
        if (take_name().empty()) {
            ends = (start[1] & many_parts) == 0 || attributes == 0;
            attributes = 0;
            continue;
        }
        ++attributes;
        const std::string type = take_name();
        std::int32_t size = 0;
        stream.read(reinterpret_cast<char*>(&size), sizeof size);
        left -= sizeof size;
        if (!stream || size < 0 || size > left) {
            throw InputError(place, "the picture is truncated");
        }
        std::string value(static_cast<std::size_t>(size), '\0');
        stream.read(value.data(), size);
        left -= size;
        if (!is_of_its_size(type, value)) {
            throw InputError(place, "the picture is damaged: an attribute is not of its size");
        }
    }
}

void check_exr_size(Imf::IStream& stream, const Place& place) {
    constexpr int bytes_before_header = 8;
    char start[bytes_before_header];
    stream.read(start, bytes_before_header);
    int version = static_cast<unsigned char>(start[4]);
    const bool has_many_parts = (static_cast<unsigned char>(start[5]) & (many_parts >> 8)) != 0;
    Sizes sizes(std::filesystem::file_size(place.file), place);
    do {
        Imf::Header header;
        header.readFrom(stream, version);
        if (header.readsNothing()) {
            break;
        }
        sizes.add(header);
    } while (has_many_parts);
    stream.seekg(0);
}

}  // namespace wend
