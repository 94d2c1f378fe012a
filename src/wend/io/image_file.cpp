#include <wend/core/contracts.h>
#include <wend/core/error.h>
#include <wend/io/atomic_file.h>
#include <wend/io/exr_file.h>
#include <wend/io/image_file.h>
#include <wend/io/stb_file.h>

#include <algorithm>
#include <cctype>

namespace wend {

Image read_image(const std::filesystem::path& file, ColourEncoding encoding) {
    return is_exr(file) ? read_exr_image(file) : read_stb_image(file, encoding);
}

Picture read_picture(const std::filesystem::path& file) {
    return read_exr(file);
}

void write_picture(const std::filesystem::path& file, const Picture& picture) {
    WEND_EXPECT(!picture.image.pixels.empty());
    std::string extension = file.extension().string();
    std::transform(extension.begin(), extension.end(), extension.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (extension == ".exr") {
        write_atomically(file, [&](const std::filesystem::path& temporary) { write_exr(temporary, picture); });
    } else if (extension == ".png") {
        write_atomically(file, encode_png(picture.image));
    } else if (extension == ".jpg" || extension == ".jpeg") {
        write_atomically(file, encode_jpeg(picture.image));
    } else {
        throw InputError(Place{file.string()}, "pictures can be written as .exr, .png or .jpg");
    }
}

}  // namespace wend
