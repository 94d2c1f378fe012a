#include <wend/app/checkpoint.h>

#include <wend/core/archive.h>
#include <wend/core/error.h>
#include <wend/io/checkpoint_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <set>
#include <string>
#include <utility>
#include <vector>

namespace wend {
namespace {

/// What decides the picture, but for the time it takes.
nlohmann::json settings_of(const Session& session, const RenderSettings& settings) {
    nlohmann::json described = session.describe(settings);
    described.erase("scene");
    described.erase("threads");
    return described;
}

nlohmann::json describe(const Session& session, const RenderSettings& settings) {
    nlohmann::json files = nlohmann::json::object();
    for (const FileStamp& file : session.files()) {
        files[file.name] = {file.bytes, file.checksum};
    }
    return {{"scene", session.scene_file()}, {"files", files}, {"settings", settings_of(session, settings)}};
}

/// Of two objects, the keys whose values are different.
std::set<std::string> different_keys(const nlohmann::json& before, const nlohmann::json& now) {
    std::set<std::string> keys;
    for (const auto& [one, other] : {std::pair(&before, &now), std::pair(&now, &before)}) {
        for (const auto& [key, value] : one->items()) {
            if (!other->contains(key) || (*other)[key] != value) {
                keys.insert(key);
            }
        }
    }
    return keys;
}

std::string change_of_file(const nlohmann::json& before, const nlohmann::json& now, const std::string& name) {
    const std::string what = name == stamp_of_changes ? "the scene's text, or a parameter of it," : name;
    return what + (!now.contains(name)      ? " is not there any more"
                   : !before.contains(name) ? " was not there before"
                                            : " has changed");
}

std::string change_of_setting(const nlohmann::json& before, const nlohmann::json& now, const std::string& name) {
    const auto value = [&](const nlohmann::json& of) { return of.contains(name) ? json_text(of[name]) : "none"; };
    return fmt::format("{} was {} and is {}", name, value(before), value(now));
}

/// What is different in two descriptions, one line each.
std::vector<std::string> differences(const nlohmann::json& before, const nlohmann::json& now) {
    std::vector<std::string> found;
    for (const std::string& file : different_keys(before["files"], now["files"])) {
        found.push_back(change_of_file(before["files"], now["files"], file));
    }
    for (const std::string& setting : different_keys(before["settings"], now["settings"])) {
        found.push_back(change_of_setting(before["settings"], now["settings"], setting));
    }
    return found;
}

/// Throws InputError where the checkpoint does not say what it is of.
nlohmann::json description_of(const Checkpoint& checkpoint, const Place& place) {
    nlohmann::json description = nlohmann::json::parse(checkpoint.description, nullptr, false);
    const auto is_object = [&](const char* key) { return description.contains(key) && description[key].is_object(); };
    if (!description.is_object() || !is_object("files") || !is_object("settings")) {
        throw InputError(place, "the checkpoint does not say what it is of");
    }
    return description;
}

}  // namespace

void save_checkpoint(const std::filesystem::path& file, const Render& render, const Session& session,
                     const RenderSettings& settings) {
    ArchiveWriter bytes;
    render.save(bytes);
    write_checkpoint(file, json_text(describe(session, settings)), bytes.bytes());
}

void resume_from(const std::filesystem::path& file, Render& render, const Session& session,
                 const RenderSettings& settings) {
    const Place place{file.string()};
    const Checkpoint checkpoint = read_checkpoint(file);
    const nlohmann::json before = description_of(checkpoint, place);
    const std::vector<std::string> different = differences(before, describe(session, settings));
    if (!different.empty()) {
        throw InputError(place, fmt::format("the checkpoint is of another render: {}", fmt::join(different, "; ")));
    }
    try {
        ArchiveReader bytes(checkpoint.state);
        render.restore(bytes);
    } catch (const InputError& error) {
        throw InputError(place, error.what());
    }
}

std::vector<std::string> layers_in_checkpoint(const std::filesystem::path& file) {
    const Place place{file.string()};
    const nlohmann::json settings = description_of(read_checkpoint(file), place)["settings"];
    std::vector<std::string> names;
    for (const nlohmann::json& name : settings.value("layers", nlohmann::json::array())) {
        if (!name.is_string()) {
            throw InputError(place, "the checkpoint does not say which layers it has");
        }
        names.push_back(name.get<std::string>());
    }
    return names;
}

}  // namespace wend
