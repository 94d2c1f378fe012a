#include <wend/io/load/refined_picture.h>
#include <wend/scene/picture_lookup.h>

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <string_view>

namespace wend {
namespace {

/// Whether the second of two words is given, and not the first, which is what is meant without any.
bool is_second(const pbrt::ParameterSet& parameters, std::string_view name, std::string_view first,
               std::string_view second) {
    const std::string word = parameters.get_string(name, std::string(first));
    if (word != first && word != second) {
        throw InputError(parameters.place_of(name),
                         fmt::format("\"{}\" of a light is {} or {}, not \"{}\"", name, first, second, word));
    }
    return word == second;
}

}  // namespace

Image refined(Image image, const pbrt::ParameterSet& parameters) {
    const bool is_even = is_second(parameters, "filter", "bilinear", "point");
    const bool repeats = is_second(parameters, "wrap", "clamp", "repeat");
    // Enough that what a pixel's middle has lies on a middle again, and edges are narrow.
    constexpr int enough = 256, most = 1024;
    const int least = std::max(std::min(image.width, image.height), 1);
    const int finer = std::min((enough + least - 1) / least, most / std::max(image.width, image.height)) | 1;
    if ((!is_even && !repeats) || finer <= 1) {
        return image;
    }
    const auto pixel = [&](int x, int y) {
        return repeats ? image.at((x + image.width) % image.width, (y + image.height) % image.height)
                       : image.at(std::clamp(x, 0, image.width - 1), std::clamp(y, 0, image.height - 1));
    };
    Image result(image.width * finer, image.height * finer);
    for (int y = 0; y < result.height; ++y) {
        for (int x = 0; x < result.width; ++x) {
            const Vec2 place((static_cast<float>(x) + 0.5f) / static_cast<float>(finer),
                             (static_cast<float>(y) + 0.5f) / static_cast<float>(finer));
            result.at(x, y) = is_even ? image.at(x / finer, y / finer) : bilinear(place, pixel);
        }
    }
    return result;
}

}  // namespace wend
