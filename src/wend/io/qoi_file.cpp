#include <wend/io/qoi_file.h>

#include <wend/io/bytes.h>
#include <wend/io/colour_encoding.h>
#include <wend/io/image_size.h>

#include <fmt/format.h>

#include <array>
#include <cstdint>

namespace wend {
namespace {

constexpr std::string_view qoi_signature = "qoif";
constexpr std::int64_t most_pixels_a_byte = 62;  // of a run

struct Pixel {
    std::uint8_t r = 0, g = 0, b = 0, a = 255;

    /// Where the decoder remembers it.
    std::size_t slot() const { return (r * 3u + g * 5u + b * 7u + a * 11u) % 64; }
};

std::uint32_t take_big_endian(Bytes& bytes) {
    std::uint32_t value = 0;
    for (int i = 0; i < 4; ++i) {
        value = value << 8 | bytes.take<std::uint8_t>();
    }
    return value;
}

/// The pixels one after the other: each byte has a tag in its highest bits, and says how a pixel follows from those
/// before.
class Pixels {
public:
    explicit Pixels(Bytes& bytes) : bytes_(bytes) { seen_.fill({0, 0, 0, 0}); }

    const Pixel& next() {
        if (run_ > 0) {
            --run_;
        } else {
            take();
            seen_[pixel_.slot()] = pixel_;
        }
        return pixel_;
    }

private:
    std::uint8_t byte() { return bytes_.take<std::uint8_t>(); }

    void take() {
        constexpr std::uint8_t rgb = 0xfe, rgba = 0xff;
        const std::uint8_t first = byte();
        const int low = first & 0x3f;
        if (first == rgb || first == rgba) {
            pixel_.r = byte();
            pixel_.g = byte();
            pixel_.b = byte();
            pixel_.a = first == rgba ? byte() : pixel_.a;
        } else if (first >> 6 == 0) {
            pixel_ = seen_[static_cast<std::size_t>(low)];
        } else if (first >> 6 == 1) {
            add((low >> 4) - 2, (low >> 2 & 3) - 2, (low & 3) - 2);
        } else if (first >> 6 == 2) {
            const int green = low - 32, second = byte();
            add(green + (second >> 4) - 8, green, green + (second & 15) - 8);
        } else {
            run_ = low;
        }
    }
    void add(int r, int g, int b) {
        pixel_.r = static_cast<std::uint8_t>(pixel_.r + r);
        pixel_.g = static_cast<std::uint8_t>(pixel_.g + g);
        pixel_.b = static_cast<std::uint8_t>(pixel_.b + b);
    }

    Bytes& bytes_;
    std::array<Pixel, 64> seen_;
    Pixel pixel_;
    int run_ = 0;
};

}  // namespace

bool is_qoi(std::string_view file) {
    return file.starts_with(qoi_signature);
}

ImageWithOpacity read_qoi(std::string_view file, const Place& place) {
    Bytes bytes(file, place);
    bytes.take(qoi_signature.size());
    const std::int64_t width = take_big_endian(bytes), height = take_big_endian(bytes);
    const auto channels = bytes.take<std::uint8_t>(), space = bytes.take<std::uint8_t>();
    if (channels < 3 || channels > 4 || space > 1) {
        throw InputError(place, "the picture is damaged: its header has an unknown number of channels or colour space");
    }
    check_image_size(width, height, file.size(), place);
    if (width * height > most_pixels_a_byte * static_cast<std::int64_t>(file.size())) {
        throw InputError(place, fmt::format("the picture is truncated: {} bytes cannot hold {} x {} pixels",
                                            file.size(), width, height));
    }
    const std::vector<float> table =
        decoding_table<std::uint8_t>(space == 0 ? ColourEncoding::srgb : ColourEncoding::linear);
    ImageWithOpacity picture{Image(static_cast<int>(width), static_cast<int>(height)), {}};
    picture.opacity.reserve(channels == 4 ? picture.image.pixels.size() : 0);
    Pixels pixels(bytes);
    for (Rgb& colour : picture.image.pixels) {
        const Pixel& pixel = pixels.next();
        colour = {table[pixel.r], table[pixel.g], table[pixel.b]};
        if (channels == 4) {
            picture.opacity.push_back(table[pixel.a]);
        }
    }
    return picture;
}

}  // namespace wend
