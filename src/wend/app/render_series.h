// The pictures that one call of wend render makes, one after another: frames of a film, or several scenes.
#pragma once

#include <wend/app/options.h>
#include <wend/app/picture_options.h>
#include <wend/app/session.h>
#include <wend/app/watched_render.h>

#include <optional>
#include <string>
#include <vector>

namespace wend {

/// Of one call of `wend render`, or of one of the pictures that it renders.
struct RenderOptions {
    CommonOptions common;
    std::vector<std::string> scenes;
    SceneOptions scene;  ///< that of one picture
    WatchOptions watch;
    PictureOptions picture;
    std::string output;
    int samples = 0;
    double seconds = 0;
    double noise = 0;
    bool denoise = false;
    std::string denoiser;  ///< the library's file or folder
    std::string adaptive;  ///< "on", "off", or as `sampling` says
    std::string sampling = "full";
    std::string subsurface = "auto";
    std::optional<std::string> passes;
    std::string load_field, save_field, save_records;
    bool half = false;
    bool record_time = false;
    std::string layers;
    std::string frames;
    bool carry_field = false;
};

/// What renders read and write.
struct RenderPaths {
    std::vector<std::string> read, resumed, written, checkpoints;

    /// Of a render that writes its picture to `output`.
    void add(const RenderOptions& options, const std::string& output);
    /// The paths that are written differ, and are not read. A checkpoint may be the one that is resumed.
    void check() const;
};

/// Renders one after another.
struct RenderSeries {
    std::string kind;                    ///< what each is, for messages: "frame" or "scene"
    std::vector<std::string> names;      ///< of each, for messages
    std::vector<RenderOptions> renders;  ///< of each

    /// Throws InputError for files that are not there, that two would write, or that one reads and another writes.
    void check_files() const;
};

/// A call with one scene: a folder as its output gets a picture of the scene's name.
RenderOptions one_scene_of(RenderOptions options);
/// Those of --frames. Throws InputError where these are none, or would write the same file.
RenderSeries frames_of(RenderOptions options);
/// Several scenes. Throws InputError where they would write the same file.
RenderSeries scenes_of(const RenderOptions& options);

}  // namespace wend
