#include <wend/app/reference.h>
#include <wend/core/error.h>
#include <wend/io/image_file.h>

namespace wend {

Reference read_reference(const std::filesystem::path& name) {
    std::filesystem::path a = name;
    std::filesystem::path b = name;
    a += ".ref-a.exr";
    b += ".ref-b.exr";
    if (std::filesystem::exists(a) && std::filesystem::exists(b)) {
        return {read_image(a), read_image(b)};
    }
    if (std::filesystem::is_regular_file(name)) {
        const Image image = read_image(name);
        return {image, image};
    }
    throw InputError(name.string() + ": no such reference: neither the pair " + a.filename().string() + ", " +
                     b.filename().string() + " nor a picture of this name");
}

}  // namespace wend
