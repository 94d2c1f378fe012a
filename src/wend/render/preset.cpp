#include <wend/render/preset.h>

#include <wend/core/error.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <utility>

namespace wend {
namespace {

using Entry = std::pair<std::string_view, bool Preset::*>;
constexpr std::array entries = {Entry{"scatter", &Preset::scatter},     Entry{"distance", &Preset::distance},
                                Entry{"direction", &Preset::direction}, Entry{"roulette", &Preset::roulette},
                                Entry{"splitting", &Preset::splitting}, Entry{"adaptive", &Preset::adaptive}};
constexpr Preset everywhere = {
    .scatter = true, .distance = true, .direction = true, .roulette = true, .splitting = true, .adaptive = true};
constexpr std::string_view full_name = "full", uniform_name = "full+uniform";

Preset full(bool adaptive) {
    Preset preset = everywhere;
    preset.adaptive = adaptive;
    preset.where_it_pays = true;
    return preset;
}

Preset only(const Entry& entry) {
    Preset preset;
    preset.*entry.second = true;
    preset.scatter = preset.guides_distance();
    return preset;
}

Preset all_but(const Entry& entry) {
    Preset preset = everywhere;
    preset.*entry.second = false;
    preset.distance = preset.distance && preset.scatter;
    return preset;
}

[[noreturn]] void reject(std::string_view text) {
    std::string message =
        "unknown sampling '" + std::string(text) + "': expected classical, full, or decisions joined by '+' from:";
    for (const auto& [name, member] : entries) {
        message += ' ' + std::string(name);
    }
    throw InputError(message);
}

}  // namespace

Preset parse_preset(std::string_view text) {
    Preset preset;
    if (text == "classical") {
        return preset;
    }
    if (text == full_name || text == uniform_name) {
        return full(text == full_name);
    }
    std::string_view rest = text;
    for (;;) {
        const std::size_t plus = rest.find('+');
        const std::string_view name = rest.substr(0, plus);
        bool known = false;
        for (const auto& [entry, member] : entries) {
            if (entry == name) {
                preset.*member = true;
                // Where to scatter is chosen along with whether to.
                preset.scatter = preset.guides_distance();
                known = true;
            }
        }
        if (!known) {
            reject(text);
        }
        if (plus == std::string_view::npos) {
            return preset;
        }
        rest.remove_prefix(plus + 1);
    }
}

std::string to_string(const Preset& preset) {
    if (preset.where_it_pays) {
        return std::string(preset.adaptive ? full_name : uniform_name);
    }
    std::string text;
    for (const auto& [name, member] : entries) {
        if (preset.*member && !(member == &Preset::scatter && preset.distance)) {
            text += (text.empty() ? "" : "+") + std::string(name);
        }
    }
    return text.empty() ? "classical" : text;
}

std::vector<Preset> ablation_presets() {
    std::vector<Preset> presets = {Preset()};
    std::transform(entries.begin(), entries.end(), std::back_inserter(presets), only);
    presets.push_back(full(true));
    std::transform(entries.begin(), entries.end(), std::back_inserter(presets), all_but);
    return presets;
}

std::string ablation_role(const Preset& preset) {
    for (const Entry& entry : entries) {
        if (preset == only(entry)) {
            return "only " + std::string(entry.first);
        }
        if (preset == all_but(entry)) {
            return "no " + std::string(entry.first);
        }
    }
    return {};
}

std::vector<std::string> guidable_decisions() {
    std::vector<std::string> names;
    for (const auto& [name, member] : entries) {
        names.emplace_back(name);
    }
    return names;
}

}  // namespace wend
