#include <wend/app/checkpoint.h>
#include <wend/core/archive.h>
#include <wend/core/error.h>
#include <wend/io/checkpoint_file.h>

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace wend {
namespace {

using nlohmann::json;

/// What decides the picture, but for the time it takes.
json settings_of(const Session& session, const RenderSettings& settings) {
    json described = session.describe(settings);
    described.erase("scene");
    described.erase("threads");
    return described;
}

json describe(const Session& session, const RenderSettings& settings) {
    json files = json::object();
    for (const FileStamp& file : session.files()) {
        files[file.name] = {file.bytes, file.checksum};
    }
    return {{"scene", session.scene_file()}, {"files", files}, {"settings", settings_of(session, settings)}};
}

/// What is different in two objects, one line each.
std::vector<std::string> differences(const json& before, const json& now, const std::string& changed) {
    std::vector<std::string> found;
    for (const auto& [key, value] : before.items()) {
        if (!now.contains(key)) {
            found.push_back(fmt::format("{} is not there any more", key));
        } else if (now[key] != value) {
            found.push_back(fmt::vformat(changed, fmt::make_format_args(key, json_text(value), json_text(now[key]))));
        }
    }
    for (const auto& [key, value] : now.items()) {
        if (!before.contains(key)) {
            found.push_back(fmt::format("{} was not there before", key));
        }
    }
    return found;
}

/// Throws InputError where the checkpoint does not say what it is of.
json description_of(const Checkpoint& checkpoint, const Place& place) {
    json description = json::parse(checkpoint.description, nullptr, false);
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
    const json before = description_of(checkpoint, place);
    const json now = describe(session, settings);
    std::vector<std::string> different = differences(before["files"], now["files"], "{0} has changed");
    for (std::string& setting : differences(before["settings"], now["settings"], "{0} was {1} and is {2}")) {
        different.push_back(std::move(setting));
    }
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
    const json settings = description_of(read_checkpoint(file), place)["settings"];
    std::vector<std::string> names;
    for (const json& name : settings.value("layers", json::array())) {
        if (!name.is_string()) {
            throw InputError(place, "the checkpoint does not say which layers it has");
        }
        names.push_back(name.get<std::string>());
    }
    return names;
}

}  // namespace wend
