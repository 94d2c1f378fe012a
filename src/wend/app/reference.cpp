#include <wend/app/reference.h>

#include <wend/app/options.h>
#include <wend/core/error.h>
#include <wend/io/image_file.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace wend {

ReferenceFiles reference_files(const std::filesystem::path& name) {
    ReferenceFiles files{name, name};
    files.a += ".ref-a.exr";
    files.b += ".ref-b.exr";
    return files;
}

std::optional<KnownReference> read_reference_pair(const std::filesystem::path& name) {
    const auto [a, b] = reference_files(name);
    if (!std::filesystem::exists(a) || !std::filesystem::exists(b)) {
        return std::nullopt;
    }
    KnownReference reference{{read_image(a), read_image(b)}, {a.string(), b.string()}};
    const Image &first = reference.halves.a, &second = reference.halves.b;
    if (first.width != second.width || first.height != second.height) {
        throw InputError(Place{b.string()},
                         fmt::format("has {} x {} pixels, and the other half, {}, has {} x {}", second.width,
                                     second.height, a.filename().string(), first.width, first.height));
    }
    return reference;
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

KnownReference read_reference(const std::filesystem::path& name) {
    if (std::optional<KnownReference> pair = read_reference_pair(name)) {
        return *std::move(pair);
    }
    if (std::filesystem::is_regular_file(name)) {
        const Image image = read_image(name);
        return {{image, image}, {name.string()}};
    }
    throw InputError(name.string() + ": no such reference: " + what_is_missing(name) + ", and no picture of this name");
}

std::string size_problem(const KnownReference& reference, const Vec2i& picture) {
    const Vec2i size = reference.size();
    if (size == picture) {
        return {};
    }
    return fmt::format("{} has {} x {} pixels, the picture {} x {}",
                       reference.files.empty() ? "the reference" : reference.files.front(), size.x, size.y, picture.x,
                       picture.y);
}

nlohmann::json reference_json(const KnownReference& reference) {
    nlohmann::json halves = nlohmann::json::array();
    for (const RenderedHalf& half : reference.rendered) {
        halves.push_back({{"seed", half.seed}, {"spp", half.samples}, {"seconds", half.seconds}});
    }
    const std::optional<double> noise = noise_of(reference.halves);
    return {{"source", reference.rendered.empty() ? "files" : "rendered"},
            {"files", reference.files},
            {"resolution", {reference.size().x, reference.size().y}},
            {"halves", std::move(halves)},
            {"noise", noise ? json_number(*noise) : nlohmann::json(nullptr)}};
}

}  // namespace wend
