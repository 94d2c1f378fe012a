#include <wend/io/gif_file.h>

#include <wend/io/bytes.h>
#include <wend/io/colour_encoding.h>
#include <wend/io/image_size.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace wend {
namespace {

constexpr std::uint8_t image_separator = 0x2c, extension_introducer = 0x21, graphic_control = 0xf9, trailer = 0x3b;

std::uint32_t take_16(Bytes& bytes) {
    const std::uint32_t low = bytes.take<std::uint8_t>();
    return low | std::uint32_t{bytes.take<std::uint8_t>()} << 8;
}

/// The colours of a table of 2^(1 + the lowest three bits of the flags), or none.
std::vector<Rgb> take_colours(Bytes& bytes, std::uint8_t flags) {
    if (!(flags & 0x80)) {
        return {};
    }
    static const std::vector<float> table = decoding_table<std::uint8_t>(ColourEncoding::srgb);
    std::vector<Rgb> colours(std::size_t{2} << (flags & 7));
    for (Rgb& colour : colours) {
        for (int c = 0; c < 3; ++c) {
            colour[c] = table[bytes.take<std::uint8_t>()];
        }
    }
    return colours;
}

/// Blocks of a length and as many bytes, up to one of length 0, put together.
std::string take_blocks(Bytes& bytes) {
    std::string data;
    while (const std::uint8_t length = bytes.take<std::uint8_t>()) {
        data += bytes.take(length);
    }
    return data;
}

/// The variable-length codes of a picture: each stands for a string of colour indices, which is one that was there
/// before and one index more.
class Codes {
public:
    Codes(std::string_view data, int index_bits, const Place& place)
        : data_(data), place_(place), clear_(1 << index_bits), index_bits_(index_bits) {
        start_anew();
    }

    /// Up to `most` indices: fewer where the codes end before.
    std::vector<std::uint8_t> indices(std::size_t most) {
        std::vector<std::uint8_t> out;
        out.reserve(most);
        while (out.size() < most) {
            const std::optional<int> code = next();
            if (!code || *code == clear_ + 1) {
                break;
            }
            if (*code == clear_) {
                start_anew();
            } else {
                append(*code, most, out);
            }
        }
        return out;
    }

private:
    struct Entry {
        int prefix;  ///< -1: none
        std::uint8_t last;
        std::uint8_t first;
        std::uint16_t length;
    };
    static constexpr int most_codes = 4096;

    void start_anew() {
        entries_.resize(static_cast<std::size_t>(clear_) + 2);
        for (int i = 0; i < clear_; ++i) {
            const auto index = static_cast<std::uint8_t>(i);
            entries_[static_cast<std::size_t>(i)] = {-1, index, index, 1};
        }
        bits_ = index_bits_ + 1;
        previous_ = -1;
    }

    std::optional<int> next() {
        while (held_ < bits_) {
            if (at_ == data_.size()) {
                return std::nullopt;
            }
            buffer_ |= std::uint32_t{static_cast<unsigned char>(data_[at_++])} << held_;
            held_ += 8;
        }
        const int code = static_cast<int>(buffer_ & ((1u << bits_) - 1));
        buffer_ >>= bits_;
        held_ -= bits_;
        return code;
    }

    void append(int code, std::size_t most, std::vector<std::uint8_t>& out) {
        const int known = static_cast<int>(entries_.size());
        if (code > known || (code == known && previous_ < 0) || (previous_ < 0 && code >= clear_)) {
            throw InputError(place_, "the picture is damaged: a code is not defined yet");
        }
        if (previous_ >= 0 && known < most_codes) {
            const Entry before = entries_[static_cast<std::size_t>(previous_)];
            const std::uint8_t last = code == known ? before.first : entries_[static_cast<std::size_t>(code)].first;
            entries_.push_back({previous_, last, before.first, static_cast<std::uint16_t>(before.length + 1)});
            if (entries_.size() == std::size_t{1} << bits_ && bits_ < 12) {
                ++bits_;
            }
        } else if (code >= known) {
            throw InputError(place_, "the picture is damaged: a code is not defined");
        }
        write(code, most, out);
        previous_ = code;
    }

    /// The string of a code, from its end.
    void write(int code, std::size_t most, std::vector<std::uint8_t>& out) const {
        const std::size_t begin = out.size();
        out.resize(begin + entries_[static_cast<std::size_t>(code)].length);
        std::size_t at = out.size();
        for (int i = code; i >= 0; i = entries_[static_cast<std::size_t>(i)].prefix) {
            out[--at] = entries_[static_cast<std::size_t>(i)].last;
        }
        out.resize(std::min(out.size(), most));
    }

    std::string_view data_;
    const Place& place_;
    std::size_t at_ = 0;
    std::uint32_t buffer_ = 0;
    int held_ = 0;  ///< bits in the buffer
    int clear_;
    int index_bits_;
    int bits_ = 0;  ///< of a code
    int previous_ = -1;
    std::vector<Entry> entries_;
};

/// The rows of an interlaced picture of this height in the order of the file: every eighth one, those between, ...
std::vector<int> rows_of(int height, bool interlaced) {
    std::vector<int> rows;
    if (!interlaced) {
        for (int y = 0; y < height; ++y) {
            rows.push_back(y);
        }
        return rows;
    }
    constexpr int passes[][2] = {{0, 8}, {4, 8}, {2, 4}, {1, 2}};
    for (const auto& [first, step] : passes) {
        for (int y = first; y < height; y += step) {
            rows.push_back(y);
        }
    }
    return rows;
}

/// Draws the picture whose description follows. What it covers is opaque then.
void draw(Bytes& bytes, const std::vector<Rgb>& common, std::optional<std::uint8_t> transparent, const Place& place,
          ImageWithOpacity& onto) {
    Image& screen = onto.image;
    const auto left = static_cast<int>(take_16(bytes)), top = static_cast<int>(take_16(bytes));
    const auto width = static_cast<int>(take_16(bytes)), height = static_cast<int>(take_16(bytes));
    const auto flags = bytes.take<std::uint8_t>();
    const std::vector<Rgb> own = take_colours(bytes, flags);
    const std::vector<Rgb>& colours = own.empty() ? common : own;
    const auto index_bits = bytes.take<std::uint8_t>();
    if (left + width > screen.width || top + height > screen.height || index_bits < 1 || index_bits > 8 ||
        colours.empty()) {
        throw InputError(place, "the picture is damaged: it exceeds the screen, or has no colours");
    }
    const std::string data = take_blocks(bytes);
    const std::vector<std::uint8_t> indices =
        Codes(data, index_bits, place).indices(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
    const std::vector<int> rows = rows_of(height, flags & 0x40);
    for (std::size_t i = 0; i < indices.size(); ++i) {
        const auto row = static_cast<std::size_t>(rows[i / static_cast<std::size_t>(width)]);
        if (indices[i] != transparent && indices[i] < colours.size()) {
            const std::size_t pixel = (static_cast<std::size_t>(top) + row) * static_cast<std::size_t>(screen.width) +
                                      static_cast<std::size_t>(left) + i % static_cast<std::size_t>(width);
            screen.pixels[pixel] = colours[indices[i]];
            onto.opacity[pixel] = 1;
        }
    }
}

}  // namespace

bool is_gif(std::string_view file) {
    return file.starts_with("GIF87a") || file.starts_with("GIF89a");
}

ImageWithOpacity read_gif(std::string_view file, const Place& place) {
    Bytes bytes(file, place);
    bytes.take(6);
    const auto width = static_cast<int>(take_16(bytes)), height = static_cast<int>(take_16(bytes));
    const auto flags = bytes.take<std::uint8_t>(), background = bytes.take<std::uint8_t>();
    bytes.take(1);  // the shape of pixels
    check_image_size(width, height, file.size(), place);
    const std::vector<Rgb> colours = take_colours(bytes, flags);
    const bool has_background = background > 0 && background < colours.size();
    ImageWithOpacity screen{Image(width, height, has_background ? colours[background] : Rgb(0.0f)), {}};
    screen.opacity.resize(screen.image.pixels.size(), has_background ? 1.0f : 0.0f);
    std::optional<std::uint8_t> transparent;
    for (auto kind = bytes.take<std::uint8_t>(); kind != trailer; kind = bytes.take<std::uint8_t>()) {
        if (kind == image_separator) {
            draw(bytes, colours, transparent, place, screen);
            return screen;
        }
        if (kind != extension_introducer) {
            throw InputError(place, "the picture is damaged: it has an unknown block");
        }
        const bool is_control = bytes.take<std::uint8_t>() == graphic_control;
        const std::string data = take_blocks(bytes);
        if (is_control && data.size() >= 4) {
            transparent = data[0] & 1 ? std::optional(static_cast<std::uint8_t>(data[3])) : std::nullopt;
        }
    }
    throw InputError(place, "the file holds no picture");
}

}  // namespace wend
