// A scene ready to render, with what the command line said about it.
#pragma once

#include <wend/app/options.h>
#include <wend/film/film.h>
#include <wend/io/file_stamp.h>
#include <wend/io/load/load_scene.h>
#include <wend/io/load/loaded_parts.h>
#include <wend/render/render.h>
#include <wend/scene/scene.h>

#include <filesystem>
#include <optional>
#include <string>

namespace wend {

/// Who watches a render is told of it so often, in the middle of a pass as well.
inline constexpr double seconds_between_looks = 0.25;

/// Options of the subcommands that render.
struct SceneOptions {
    std::string file;
    std::string resolution;
    std::string crop;
    std::optional<int> max_depth;
    std::string sampler;

    void add_to(CLI::App& command);
    /// All but the file.
    void add_choices_to(CLI::App& command);
    /// Throws InputError for what is wrong whatever the scene.
    void check() const;
};

/// The name of the stamp (Session::files()) of what the scene's files do not have.
inline const std::string stamp_of_changes = "changes";

/// A scene's description, and what tells it from others that have the same files.
struct ReadScene {
    pbrt::Description description;
    std::string changes;  ///< a text of one line; empty: it is that of its files
};

/// Reads `options.file`. A pipe tells its scene once; the scene's files are looked up in the current folder then.
/// Throws InputError.
ReadScene read_scene(const SceneOptions& options);
/// Of a text that is not in a file. `options.file` is what messages call it.
ReadScene read_scene(const std::string& text, const std::filesystem::path& folder, const SceneOptions& options);

/// A loaded scene and the settings to render it with.
class Session {
public:
    /// Loads the scene; warnings go to the notes. Throws InputError.
    Session(const SceneOptions& options, const CommonOptions& common, const Streams& streams);
    /// Of a scene that has been parsed, and perhaps changed. `changes` says in which way: it tells the scene from that
    /// of the files; empty: in none. What `parts` has of an `earlier` session (null: there is none), whose description
    /// differs in parameters alone, is shared with it as far as it is the same, acceleration structures included;
    /// afterwards they are the parts of this one. Throws InputError.
    Session(const SceneOptions& options, const CommonOptions& common, pbrt::Description description,
            const std::string& changes, LoadedParts& parts, const Session* earlier);

    const Scene& scene() const { return scene_; }
    const RenderSettings& settings() const { return settings_; }
    /// With layers for which these settings ask.
    Film new_film(const RenderSettings& settings) const;
    const std::string& film_file() const { return film_file_; }
    const std::string& scene_file() const { return scene_file_; }
    const Vec2i& resolution() const { return resolution_; }
    /// Of all the files that the scene consists of, and of what was changed.
    const std::vector<FileStamp>& files() const { return files_; }
    /// LoadedScene::warnings.
    const std::vector<std::string>& warnings() const { return warnings_; }

    /// The settings as JSON, as the "settings" key of results has them.
    nlohmann::json describe(const RenderSettings& settings) const;
    /// The film's picture with metadata: scene and its digest, settings, seed, version, samples.
    Picture picture(const Film& film, const RenderSettings& settings, const RenderStatistics& statistics) const;

private:
    Session(const SceneOptions& options, const CommonOptions& common, ReadScene read);
    Session(const SceneOptions& options, const CommonOptions& common, LoadedScene loaded,
            const Session* earlier = nullptr);
    /// `changes` as of ReadScene.
    void stamp(const std::string& changes);

    std::string scene_file_;
    std::string film_file_;
    pbrt::ColourSpace colour_space_;  // of pictures
    Vec2i resolution_;
    PixelRect crop_;
    std::vector<FileStamp> files_;
    std::vector<std::string> warnings_;
    RenderSettings settings_;
    Scene scene_;
};

/// Throws InputError unless a picture of this name can be written: a known extension, in a folder that takes it.
void require_writable_picture(const std::filesystem::path& file);

}  // namespace wend
