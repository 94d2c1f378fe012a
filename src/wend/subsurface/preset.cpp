#include <wend/subsurface/preset.h>

#include <wend/core/error.h>

#include <algorithm>
#include <array>

namespace wend {
namespace {

struct Entry {
    std::string_view name;
    std::optional<InteriorStrategy> strategy;
};

using enum InteriorStrategy;
constexpr std::array canonical = {Entry{"classical", std::nullopt}, Entry{"dwivedi", entry}, Entry{"closest", closest},
                                  Entry{"incident", incident}, Entry{"auto", learned}};
/// What scripts may ask for.
constexpr std::array aliases = {Entry{"learned", learned}, Entry{"planar", closest}};

}  // namespace

std::string subsurface_names() {
    std::string names;
    for (const Entry& e : canonical) {
        names += (names.empty() ? "" : ", ") + std::string(e.name);
    }
    return names;
}

SubsurfacePreset parse_subsurface(std::string_view text) {
    const auto is_meant = [&](const Entry& e) { return e.name == text; };
    if (const auto found = std::find_if(canonical.begin(), canonical.end(), is_meant); found != canonical.end()) {
        return {found->strategy};
    }
    if (const auto found = std::find_if(aliases.begin(), aliases.end(), is_meant); found != aliases.end()) {
        return {found->strategy};
    }
    throw InputError("unknown subsurface sampling '" + std::string(text) + "': expected one of " + subsurface_names());
}

std::string to_string(const SubsurfacePreset& preset) {
    const auto found =
        std::find_if(canonical.begin(), canonical.end(), [&](const Entry& e) { return e.strategy == preset.strategy; });
    return std::string(found->name);
}

}  // namespace wend
