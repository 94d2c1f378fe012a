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

std::string what_is_missing(const std::filesystem::path& name) {
    const auto [a, b] = reference_files(name);
    const std::string a_name = a.filename().string();
    const std::string b_name = b.filename().string();
    if (std::filesystem::exists(a)) {
        return a_name + " without " + b_name;
    }
    return std::filesystem::exists(b) ? b_name + " without " + a_name : "no " + a_name;
}

Reference read_reference(const std::filesystem::path& name) {
    if (std::optional<Reference> pair = read_reference_pair(name)) {
        return *std::move(pair);
    }
    if (std::filesystem::is_regular_file(name)) {
        const Image image = read_image(name);
        return {image, image};
    }
    throw InputError(name.string() + ": no such reference: " + what_is_missing(name) + ", and no picture of this name");
}

}  // namespace wend
