#include <wend/app/reference.h>
#include <wend/core/error.h>
#include <wend/io/image_file.h>

namespace wend {

ReferenceFiles reference_files(const std::filesystem::path& name) {
    ReferenceFiles files{name, name};
    files.a += ".ref-a.exr";
    files.b += ".ref-b.exr";
    return files;
}

std::optional<Reference> read_reference_pair(const std::filesystem::path& name) {
    const auto [a, b] = reference_files(name);
    if (std::filesystem::exists(a) && std::filesystem::exists(b)) {
        return Reference{read_image(a), read_image(b)};
    }
    return std::nullopt;
}

Reference read_reference(const std::filesystem::path& name) {
    if (std::optional<Reference> pair = read_reference_pair(name)) {
        return *std::move(pair);
    }
    if (std::filesystem::is_regular_file(name)) {
        const Image image = read_image(name);
        return {image, image};
    }
    const auto [a, b] = reference_files(name);
    throw InputError(name.string() + ": no such reference: neither the pair " + a.filename().string() + ", " +
                     b.filename().string() + " nor a picture of this name");
}

}  // namespace wend
