#include <wend/io/pbrt/colour_value.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <utility>

namespace wend::pbrt {
namespace {

constexpr std::array<std::pair<ColourSpace, std::string_view>, 4> names_of_spaces = {
    {{ColourSpace::srgb, "srgb"},
     {ColourSpace::dci_p3, "dci-p3"},
     {ColourSpace::rec2020, "rec2020"},
     {ColourSpace::aces2065_1, "aces2065-1"}}};

}  // namespace

std::string_view to_string(ColourSpace space) {
    return names_of_spaces[static_cast<std::size_t>(space)].second;
}

std::optional<ColourSpace> colour_space_named(std::string_view name) {
    const auto is_same = [](char a, char b) { return a == std::tolower(static_cast<unsigned char>(b)); };
    for (const auto& [space, known] : names_of_spaces) {
        if (std::equal(known.begin(), known.end(), name.begin(), name.end(), is_same)) {
            return space;
        }
    }
    return std::nullopt;
}

}  // namespace wend::pbrt
