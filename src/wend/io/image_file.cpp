#include <wend/io/image_file.h>

#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/io/atomic_file.h>
#include <wend/io/exr_file.h>
#include <wend/io/gif_file.h>
#include <wend/io/gzip.h>
#include <wend/io/pfm_file.h>
#include <wend/io/pnm_file.h>
#include <wend/io/qoi_file.h>
#include <wend/io/stb_file.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <fstream>
#include <optional>
#include <string_view>
#include <utility>

namespace wend {

namespace {

ImageWithOpacity read_any(const std::filesystem::path& file, ColourEncoding encoding) {
    if (is_exr(file)) {
        return read_exr_image(file);
    }
    const Place place{file.string()};
    std::string bytes = read_file(file);
    if (is_pfm(bytes)) {
        return {read_pfm(bytes, place), {}};
    }
    if (is_pnm(bytes)) {
        return {read_pnm(bytes, place), {}};
    }
    if (is_gif(bytes)) {
        return read_gif(bytes, place);
    }
    if (is_qoi(bytes)) {
        return read_qoi(bytes, place);
    }
    return read_stb_image(std::move(bytes), place, encoding);
}

}  // namespace

Image read_image(const std::filesystem::path& file, ColourEncoding encoding) {
    return read_any(file, encoding).image;
}

ImageWithOpacity read_image_with_opacity(const std::filesystem::path& file, ColourEncoding encoding) {
    ImageWithOpacity picture = read_any(file, encoding);
    if (std::all_of(picture.opacity.begin(), picture.opacity.end(), [](float a) { return a == 1; })) {
        picture.opacity.clear();
    }
    return picture;
}

bool is_png(const std::filesystem::path& file) {
    std::array<char, 4> start{};
    std::ifstream(file, std::ios::binary).read(start.data(), start.size());
    return std::string_view(start.data(), start.size()) == "\x89PNG";
}

Picture read_picture(const std::filesystem::path& file) {
    return read_exr(file);
}

namespace {

enum class PictureKind { exr, png, jpeg };

std::optional<PictureKind> kind_of(const std::filesystem::path& file) {
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".exr") {
        return PictureKind::exr;
    }
    if (extension == ".png") {
        return PictureKind::png;
    }
    if (extension == ".jpg" || extension == ".jpeg") {
        return PictureKind::jpeg;
    }
    if (is_device(file)) {
        return PictureKind::exr;
    }
    return std::nullopt;
}

}  // namespace

bool is_known_picture_extension(const std::filesystem::path& file) {
    return kind_of(file).has_value();
}

void require_known_picture_extension(const std::filesystem::path& file) {
    if (!is_known_picture_extension(file)) {
        throw InputError(Place{file.string()}, "pictures can be written as .exr, .png or .jpg");
    }
}

bool is_exr_name(const std::filesystem::path& file) {
    return kind_of(file) == PictureKind::exr;
}

void require_exr_extension(const std::filesystem::path& file) {
    if (!is_exr_name(file)) {
        throw InputError(Place{file.string()}, "half floats can be written as .exr only");
    }
}

std::string png_bytes(const Image& image) {
    return encode_png(image);
}

void write_picture(const std::filesystem::path& file, const Picture& picture, const PictureFormat& format) {
    WEND_EXPECT(!picture.image.pixels.empty());
    require_known_picture_extension(file);
    switch (*kind_of(file)) {
        case PictureKind::exr:
            write_atomically(file,
                             [&](const std::filesystem::path& temporary) { write_exr(temporary, picture, format); });
            break;
        case PictureKind::png:
            write_atomically(file, encode_png(picture.image));
            break;
        case PictureKind::jpeg:
            write_atomically(file, encode_jpeg(picture.image));
            break;
    }
}

void write_colours(const std::filesystem::path& file, const Picture& picture) {
    WEND_EXPECT(!picture.image.pixels.empty());
    require_exr_extension(file);
    write_atomically(file, [&](const std::filesystem::path& temporary) { write_exr_colours(temporary, picture); });
}

}  // namespace wend
