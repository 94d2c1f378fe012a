#include <wend/film/comparable.h>

#include <wend/core/error.h>

namespace wend {
namespace {

std::string size_text(const Image& image) {
    return std::to_string(image.width) + 'x' + std::to_string(image.height);
}

}  // namespace

void require_finite(const Image& image, const std::string& name) {
    if (image.width < 1 || image.height < 1 ||
        image.pixels.size() != static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height)) {
        throw InputError(name + " has no pixels");
    }
    for (int y = 0; y < image.height; ++y) {
        for (int x = 0; x < image.width; ++x) {
            if (!is_finite(image.at(x, y))) {
                throw InputError(name + " is not finite at pixel (" + std::to_string(x) + ", " + std::to_string(y) +
                                 ')');
            }
        }
    }
}

void require_same_size(const Image& image, const Image& reference, const std::string& reference_name) {
    if (image.width != reference.width || image.height != reference.height) {
        throw InputError("the image is " + size_text(image) + " pixels but " + reference_name + " is " +
                         size_text(reference));
    }
}

}  // namespace wend
