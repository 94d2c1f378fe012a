#include <wend/io/stb_file.h>

#include <wend/core/error.h>
#include <wend/io/colour_encoding.h>
#include <wend/io/image_size.h>
#include <wend/io/jpeg_check.h>
#include <wend/io/png_check.h>

#define STB_IMAGE_STATIC
#define STB_IMAGE_IMPLEMENTATION
#define STBI_NO_STDIO
#define STBI_ONLY_PNG
#define STBI_ONLY_JPEG
#define STBI_ONLY_TGA
#define STBI_ONLY_BMP
#define STBI_ONLY_HDR
#define STBI_ONLY_PSD
#include <stb_image.h>

#define STB_IMAGE_WRITE_STATIC
#define STB_IMAGE_WRITE_IMPLEMENTATION
#define STBI_WRITE_NO_STDIO
#include <stb_image_write.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <string_view>
#include <type_traits>
#include <vector>

namespace wend {
namespace {

/// Feeds stb, and notices when it asks for more than there is.
class Source {
public:
    explicit Source(const std::string& bytes) : bytes_(bytes) {}

    int read(char* data, int size) {
        if (!buffer_) {
            buffer_ = data;
        }
        const int count = static_cast<int>(std::min<std::size_t>(static_cast<std::size_t>(size), bytes_.size() - at_));
        std::memcpy(data, bytes_.data() + at_, static_cast<std::size_t>(count));
        at_ += static_cast<std::size_t>(count);
        // stb's first read fills its buffer. It refills that for the sake of one byte; other reads want all they ask
        // for.
        ran_out_ = ran_out_ || (data == buffer_ ? count == 0 : count < size);
        if (data == buffer_ && count == 0) {
            // Told that there is nothing, stb would go on with zeros for ever, which as runs of no length lead nowhere.
            // Line breaks end whatever it looks for: words, runs, segments.
            std::memset(data, '\n', static_cast<std::size_t>(size));
            return size;
        }
        return count;
    }
    void skip(int count) {
        ran_out_ = ran_out_ || (count > 0 && static_cast<std::size_t>(count) > bytes_.size() - at_);
        at_ = std::min(at_ + static_cast<std::size_t>(std::max(count, 0)), bytes_.size());
    }
    bool at_end() const { return at_ == bytes_.size(); }
    bool ran_out() const { return ran_out_; }

private:
    const std::string& bytes_;
    std::size_t at_ = 0;
    const char* buffer_ = nullptr;
    bool ran_out_ = false;
};

constexpr stbi_io_callbacks callbacks = {
    [](void* self, char* data, int size) { return static_cast<Source*>(self)->read(data, size); },
    [](void* self, int count) { static_cast<Source*>(self)->skip(count); },
    [](void* self) { return static_cast<int>(static_cast<Source*>(self)->at_end()); }};

/// `channels` is 3, or 4 with an opacity.
template <class Number, class Decode>
ImageWithOpacity to_image(int width, int height, int channels, const Number* values, const Decode& decode) {
    ImageWithOpacity picture{Image(width, height), {}};
    picture.opacity.reserve(channels == 4 ? picture.image.pixels.size() : 0);
    for (Rgb& pixel : picture.image.pixels) {
        pixel = {decode(values[0]), decode(values[1]), decode(values[2])};
        if (channels == 4) {
            picture.opacity.push_back(decode(values[3]));
        }
        values += channels;
    }
    return picture;
}

/// Whether a file with so many channels has an opacity at each pixel, beside red, green and blue. That of a PNG's
/// palette does not count.
bool has_opacity(std::string_view file, int channels) {
    constexpr std::size_t colour_type = 25;
    constexpr char rgb_with_opacity = 6;
    if (!file.starts_with("\x89PNG")) {
        return channels == 4;
    }
    return file.size() > colour_type && file[colour_type] == rgb_with_opacity;
}

/// Reads `channels` with one of stb's loaders and hands the values on.
template <class Load, class Decode>
ImageWithOpacity load(const std::string& bytes, const Place& place, int channels, const Load& loader,
                      const Decode& decode) {
    Source source(bytes);
    int width = 0, height = 0, channels_there = 0;
    auto* values = loader(&callbacks, &source, &width, &height, &channels_there, channels);
    const std::unique_ptr<std::remove_pointer_t<decltype(values)>, decltype(&stbi_image_free)> owner(values,
                                                                                                     stbi_image_free);
    if (source.ran_out()) {
        throw InputError(place, "the picture is truncated");
    }
    if (!values) {
        throw InputError(place, std::string("not a readable picture: ") + stbi_failure_reason());
    }
    return to_image(width, height, channels, values, decode);
}

std::vector<unsigned char> to_bytes(const Image& image) {
    std::vector<unsigned char> bytes;
    bytes.reserve(image.pixels.size() * 3);
    for (const Rgb& pixel : image.pixels) {
        for (int c = 0; c < 3; ++c) {
            const float clamped = pixel[c] > 0 ? std::min(pixel[c], 1.0f) : 0.0f;
            bytes.push_back(static_cast<unsigned char>(linear_to_srgb(clamped) * 255 + 0.5f));
        }
    }
    return bytes;
}

void append(void* text, void* data, int size) {
    static_cast<std::string*>(text)->append(static_cast<const char*>(data), static_cast<std::size_t>(size));
}

}  // namespace

ImageWithOpacity read_stb_image(std::string bytes, const Place& place, ColourEncoding wanted) {
    const ColourEncoding encoding = bytes.starts_with("\x89PNG") ? wanted : ColourEncoding::srgb;
    prepare_png(bytes, place);
    if (!huffman_tables_fit(bytes)) {
        throw InputError(place, "the picture is damaged: a Huffman table is too large");
    }
    int width = 0, height = 0, channels = 0;
    Source source(bytes);
    if (!stbi_info_from_callbacks(&callbacks, &source, &width, &height, &channels)) {
        throw InputError(place, source.ran_out() ? "the picture is truncated"
                                                 : "not a picture of a known kind (EXR, PNG, JPEG, TGA, BMP, HDR, PFM, "
                                                   "PGM, PPM, GIF, QOI or PSD)");
    }
    const bool is_bmp = bytes.starts_with("BM");
    // A BMP whose rows come from the top says so by a negative height.
    const std::int64_t rows = is_bmp ? std::abs(std::int64_t{height}) : height;
    check_image_size(width, rows, bytes.size(), place);
    // It is not compressed, and what it lacks would be read as zeros one by one.
    if (is_bmp && static_cast<std::uint64_t>(width) * static_cast<std::uint64_t>(rows) / 8 > bytes.size()) {
        throw InputError(place, "the picture is truncated");
    }
    const int wanted_channels = has_opacity(bytes, channels) ? 4 : 3;
    if (Source probe(bytes); stbi_is_hdr_from_callbacks(&callbacks, &probe)) {
        return load(bytes, place, 3, stbi_loadf_from_callbacks, [](float v) { return v; });
    }
    if (Source probe(bytes); stbi_is_16_bit_from_callbacks(&callbacks, &probe)) {
        return load(bytes, place, wanted_channels, stbi_load_16_from_callbacks,
                    [table = decoding_table<std::uint16_t>(encoding)](std::uint16_t v) { return table[v]; });
    }
    return load(bytes, place, wanted_channels, stbi_load_from_callbacks,
                [table = decoding_table<std::uint8_t>(encoding)](std::uint8_t v) { return table[v]; });
}

std::string encode_png(const Image& image) {
    std::string file;
    if (!stbi_write_png_to_func(append, &file, image.width, image.height, 3, to_bytes(image).data(), 0)) {
        throw std::runtime_error("cannot encode the picture as PNG");
    }
    return file;
}

std::string encode_jpeg(const Image& image) {
    constexpr int quality = 95;
    std::string file;
    if (!stbi_write_jpg_to_func(append, &file, image.width, image.height, 3, to_bytes(image).data(), quality)) {
        throw std::runtime_error("cannot encode the picture as JPEG");
    }
    return file;
}

}  // namespace wend
