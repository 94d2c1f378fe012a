#include <wend/io/pfm_file.h>

#include <wend/io/header_words.h>
#include <wend/io/image_size.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>

namespace wend {
namespace {

float float_at(const char* bytes, bool swapped) {
    std::array<char, sizeof(float)> copy;
    std::memcpy(copy.data(), bytes, copy.size());
    if (swapped) {
        std::reverse(copy.begin(), copy.end());
    }
    return std::bit_cast<float>(copy);
}

}  // namespace

bool is_pfm(std::string_view file) {
    return file.size() > 2 && (file.starts_with("PF") || file.starts_with("Pf")) &&
           (file[2] == '\n' || file[2] == '\r' || file[2] == ' ' || file[2] == '\t');
}

Image read_pfm(std::string_view file, const Place& place) {
    constexpr double most = 1e9, largest_factor = 1e30;
    HeaderWords header(file, place);
    const bool is_colour = header.next(false) == "PF";
    const auto width = static_cast<std::int64_t>(header.number(false, most));
    const auto height = static_cast<std::int64_t>(header.number(false, most));
    const double factor = header.number(false, largest_factor);
    check_image_size(width, height, file.size(), place);
    const std::string_view bytes = header.rest();
    const std::size_t channels = is_colour ? 3 : 1;
    const std::size_t row_bytes = static_cast<std::size_t>(width) * channels * sizeof(float);
    if (bytes.size() / row_bytes < static_cast<std::size_t>(height)) {
        throw InputError(place, "the picture is truncated");
    }
    const bool swapped = (factor < 0) != (std::endian::native == std::endian::little);
    const auto scale = static_cast<float>(factor == 0 ? 1.0 : std::abs(factor));
    Image image(static_cast<int>(width), static_cast<int>(height));
    const char* at = bytes.data();
    for (int y = image.height - 1; y >= 0; --y) {
        for (int x = 0; x < image.width; ++x) {
            Rgb& pixel = image.at(x, y);
            for (int c = 0; c < 3; ++c) {
                pixel[c] = float_at(at + (is_colour ? c : 0) * static_cast<int>(sizeof(float)), swapped) * scale;
            }
            at += channels * sizeof(float);
        }
    }
    return image;
}

}  // namespace wend
