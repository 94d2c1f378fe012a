// What viewers are shown and what they ask for: it stands between the thread that renders and the one that serves.
#pragma once

#include <wend/film/picture.h>
#include <wend/guide/fit.h>
#include <wend/render/render.h>
#include <wend/view/pixel_report.h>

#include <atomic>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace wend {

/// How far a picture was at a time.
struct NoisePoint {
    double seconds = 0;
    int samples = 0;   ///< per pixel
    double noise = 0;  ///< Film::relative_noise()
};

/// Names of a picture's layers.
std::vector<std::string> layer_names(const Picture& picture);

/// A picture that is looked at: one that is being rendered, or a finished one. What its pointers lead to never changes.
struct ShownPicture {
    std::string name;
    std::string phase;                       ///< "learning", "rendering", "paused", "done" or "file"
    Vec2i size{0, 0}, offset{0, 0};          ///< of the crop window
    std::shared_ptr<const Picture> picture;  ///< null: none yet
    std::vector<std::string> layers;         ///< names of those that it has once they are wanted
    std::uint64_t version = 0;               ///< another one for every other `picture`
    RenderProgress progress;
    std::vector<NoisePoint> curve;
    std::vector<WalkKindStatistics> kinds;
    std::shared_ptr<const guide::Fields> fields;     ///< null: nothing is guided
    std::shared_ptr<const SharedRecords> records{};  ///< null: none are kept
};

/// What a viewer asks of whoever renders.
struct ViewCommand {
    enum class Kind { pause, go_on, more_seconds, save, restart, stop };

    Kind kind = Kind::pause;
    std::size_t picture = 0;
    double seconds = 0;    ///< more_seconds
    std::string sampling;  ///< restart: by this preset
};

/// Safe to be used from any thread.
class Board {
public:
    /// Of the picture at an index; the first time at the end of the list. Of another version than the last it is the
    /// answer to what was wanted.
    void show(std::size_t index, ShownPicture shown);
    std::vector<ShownPicture> pictures() const;
    /// Throws InputError where there is none of that index.
    ShownPicture picture(std::size_t index) const;

    /// Asks for a newer picture than that of `version`, with or without layers.
    void want(std::size_t index, std::uint64_t version, bool layers);
    /// Whether a newer one than that of `version` is asked for.
    bool is_wanted(std::size_t index, std::uint64_t version) const;
    /// Whether layers were asked for since the third last version: whoever looks at one asks for each version, and one
    /// that is slow for a later one.
    bool wants_layers(std::size_t index) const;

    /// Asks; beyond a number that nobody can mean to wait for nothing is kept.
    void post(ViewCommand command);
    /// What was asked since the last time.
    std::vector<ViewCommand> take();

    /// What is said to viewers: that a file was written, or why not.
    void say(std::string note);
    std::string note() const;

private:
    struct Wanted {
        bool any = false;
        int versions_with_layers = 0;  ///< that are still to have them
        std::uint64_t beyond = 0;
    };

    mutable std::mutex mutex_;
    std::vector<ShownPicture> pictures_;
    std::vector<Wanted> wanted_;
    std::vector<ViewCommand> commands_;
    std::string note_;
};

}  // namespace wend
