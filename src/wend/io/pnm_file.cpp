#include <wend/io/pnm_file.h>

#include <wend/io/colour_encoding.h>
#include <wend/io/header_words.h>
#include <wend/io/image_size.h>

#include <algorithm>
#include <cstdint>

namespace wend {
namespace {

constexpr std::uint32_t largest_of_all = 65535;

/// Values in text.
class TextValues {
public:
    TextValues(std::string_view text, const Place& place) : words_(text, place) {}

    static std::size_t most(std::size_t bytes) { return bytes / 2 + 1; }  // a digit and a space each
    std::uint32_t next() {
        return static_cast<std::uint32_t>(std::max(words_.number(true, double{largest_of_all}), 0.0));
    }

private:
    HeaderWords words_;
};

/// Values of one or two bytes, of which the first is the larger part.
template <int bytes>
class BinaryValues {
public:
    BinaryValues(std::string_view values, const Place&) : at_(values.data()) {}

    static std::size_t most(std::size_t available) { return available / bytes; }
    std::uint32_t next() {
        std::uint32_t value = 0;
        for (int i = 0; i < bytes; ++i) {
            value = value << 8 | static_cast<unsigned char>(*at_++);
        }
        return value;
    }

private:
    const char* at_;
};

struct PnmHeader {
    int width, height;
    std::uint32_t largest;
    bool is_grey;
};

template <class Values>
Image read_pixels(const PnmHeader& header, std::string_view rest, const Place& place) {
    const std::size_t pixels = static_cast<std::size_t>(header.width) * static_cast<std::size_t>(header.height);
    if (Values::most(rest.size()) < pixels * (header.is_grey ? 1 : 3)) {
        throw InputError(place, "the picture is truncated");
    }
    const std::vector<float> table = decoding_table(ColourEncoding::srgb, header.largest);
    Values values(rest, place);
    const auto next = [&] { return table[std::min(values.next(), header.largest)]; };
    Image image(header.width, header.height);
    for (Rgb& pixel : image.pixels) {
        if (header.is_grey) {
            pixel = Rgb(next());
        } else {
            for (int c = 0; c < 3; ++c) {
                pixel[c] = next();
            }
        }
    }
    return image;
}

}  // namespace

bool is_pnm(std::string_view file) {
    constexpr std::string_view kinds = "2356";
    return file.size() > 2 && file[0] == 'P' && kinds.find(file[1]) != kinds.npos &&
           (file[2] == '\n' || file[2] == '\r' || file[2] == ' ' || file[2] == '\t' || file[2] == '#');
}

Image read_pnm(std::string_view file, const Place& place) {
    constexpr double most = 1e9;
    const char kind = file[1];
    HeaderWords words(file.substr(2), place);
    const double width = words.number(true, most), height = words.number(true, most);
    check_image_size(static_cast<std::int64_t>(width), static_cast<std::int64_t>(height), file.size(), place);
    const double largest = words.number(true, double{largest_of_all});
    if (largest < 1) {
        throw InputError(place, "the picture is damaged: its largest value is below 1");
    }
    const PnmHeader header{static_cast<int>(width), static_cast<int>(height), static_cast<std::uint32_t>(largest),
                           kind == '2' || kind == '5'};
    if (kind == '2' || kind == '3') {
        return read_pixels<TextValues>(header, words.rest(), place);
    }
    return header.largest < 256 ? read_pixels<BinaryValues<1>>(header, words.rest(), place)
                                : read_pixels<BinaryValues<2>>(header, words.rest(), place);
}

}  // namespace wend
