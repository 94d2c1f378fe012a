#include <wend/core/error.h>
#include <wend/subsurface/preset.h>

#include <algorithm>

namespace wend {
namespace {

struct Entry {
    std::string_view name;
    std::vector<InteriorStrategy> strategies;
};

const std::vector<Entry>& entries() {
    using enum InteriorStrategy;
    static const std::vector<Entry> table = {{"classical", {}},      {"dwivedi", {entry}},
                                             {"closest", {closest}}, {"incident", {incident}},
                                             {"learned", {learned}}, {"auto", {closest, learned}}};
    return table;
}

}  // namespace

std::string subsurface_names() {
    std::string names;
    for (const Entry& e : entries()) {
        names += (names.empty() ? "" : ", ") + std::string(e.name);
    }
    return names;
}

SubsurfacePreset parse_subsurface(std::string_view text) {
    for (const Entry& e : entries()) {
        if (e.name == text) {
            return {e.strategies};
        }
    }
    // Scripts may ask for the solution of layers, which was worse than this in every scene.
    if (text == "planar") {
        return {{InteriorStrategy::closest}};
    }
    throw InputError("unknown subsurface sampling '" + std::string(text) + "': expected one of " + subsurface_names());
}

std::string to_string(const SubsurfacePreset& preset) {
    const auto found = std::find_if(entries().begin(), entries().end(),
                                    [&](const Entry& e) { return e.strategies == preset.strategies; });
    return std::string(found->name);
}

}  // namespace wend
