#include <wend/app/render_series.h>

#include <wend/app/frames.h>
#include <wend/core/error.h>
#include <wend/io/atomic_file.h>

#include <fmt/format.h>

#include <filesystem>
#include <system_error>
#include <utility>

namespace wend {
namespace {

/// The options that name files: these differ from render to render.
std::vector<std::string*> names_read(RenderOptions& options) {
    return {&options.scene.file, &options.load_field, &options.watch.resume};
}
std::vector<std::string*> names_written(RenderOptions& options) {
    return {&options.output,       &options.common.json,      &options.save_field,
            &options.save_records, &options.watch.checkpoint, &options.watch.progress_file};
}

/// With the number where names have a place for it.
RenderOptions numbered(RenderOptions options, int number) {
    for (const auto& names : {names_read(options), names_written(options)}) {
        for (std::string* name : names) {
            *name = with_frame_number(*name, number);
        }
    }
    return options;
}

/// Refuses renders that would write the same file.
void require_numbers(const std::vector<std::string*>& names, const char* kind) {
    for (const std::string* name : names) {
        if (!name->empty() && *name != "-" && !is_device(*name) && !has_frame_number(*name)) {
            throw InputError(Place{*name},
                             fmt::format("all {0}s would write it: put #### where the {0}'s number goes", kind));
        }
    }
}

/// Where pictures go, unless its name is that of one.
bool is_folder(const std::string& name) {
    std::error_code error;
    return name.ends_with('/') || (!name.ends_with(".exr") && std::filesystem::is_directory(name, error));
}

/// The picture of a scene in a folder.
std::string picture_in(const std::string& folder, const std::string& scene) {
    return (std::filesystem::path(folder) / (std::filesystem::path(scene).stem().string() + ".exr")).string();
}

}  // namespace

void RenderPaths::add(const RenderOptions& options, const std::string& output) {
    read.insert(read.end(), {options.scene.file, options.load_field});
    resumed.push_back(options.watch.resume);
    written.insert(written.end(), {output, options.common.json, options.save_field, options.save_records,
                                   options.watch.progress_file});
    checkpoints.push_back(options.watch.checkpoint);
}

void RenderPaths::check() const {
    require_distinct(resumed, written);
    std::vector<std::string> all = written;
    all.insert(all.end(), checkpoints.begin(), checkpoints.end());
    require_distinct(read, all);
}

void RenderSeries::check_files() const {
    RenderPaths paths;
    for (std::size_t i = 0; i < renders.size(); ++i) {
        RenderOptions one = renders[i];
        for (const std::string* name : names_read(one)) {
            std::error_code error;
            if (!name->empty() && !std::filesystem::exists(*name, error)) {
                throw InputError(Place{*name}, fmt::format("does not exist, and {} {} wants it", kind, names[i]));
            }
        }
        paths.add(one, one.output);
    }
    paths.check();
}

RenderOptions one_scene_of(RenderOptions options) {
    options.scene.file = options.scenes.front();
    if (!options.output.empty() && is_folder(options.output)) {
        options.output = picture_in(options.output, options.scene.file);
    }
    return options;
}

RenderSeries frames_of(RenderOptions options) {
    const std::vector<int> frames = parse_frames(options.frames);
    if (options.scenes.size() > 1) {
        throw InputError(Place{options.scenes[1]}, "a second scene: --frames has one, with #### for the number");
    }
    options.scene.file = options.scenes.front();
    if (options.output.empty()) {
        // The scenes' own names for their pictures may all be the same.
        options.output = std::filesystem::path(options.scene.file).stem().string() + ".exr";
    } else if (is_folder(options.output)) {
        options.output = picture_in(options.output, options.scene.file);
    }
    if (!has_frame_number(options.scene.file)) {
        throw InputError(Place{options.scene.file},
                         "--frames wants the frame's number in the scene's name: put #### in its place");
    }
    if (frames.size() > 1) {
        require_numbers(names_written(options), "frame");
    }
    RenderSeries series{"frame", {}, {}};
    for (const int frame : frames) {
        series.names.push_back(std::to_string(frame));
        series.renders.push_back(numbered(options, frame));
    }
    return series;
}

RenderSeries scenes_of(const RenderOptions& options) {
    if (!options.output.empty() && !is_folder(options.output)) {
        throw InputError(Place{options.output},
                         "is no folder, and several scenes have several pictures: name a folder "
                         "that is there, or none for this one");
    }
    RenderOptions others = options;
    others.output.clear();
    require_numbers(names_written(others), "scene");
    RenderSeries series{"scene", {}, {}};
    for (const std::string& scene : options.scenes) {
        RenderOptions& one = series.renders.emplace_back(numbered(others, static_cast<int>(series.renders.size()) + 1));
        series.names.push_back(scene);
        one.scene.file = scene;
        one.output = picture_in(options.output, scene);
    }
    return series;
}

}  // namespace wend
