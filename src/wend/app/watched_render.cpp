#include <wend/app/watched_render.h>

#include <wend/app/checkpoint.h>
#include <wend/app/progress.h>
#include <wend/app/progress_lines.h>
#include <wend/core/error.h>
#include <wend/core/team.h>
#include <wend/io/atomic_file.h>

#include <CLI/CLI.hpp>

#include <algorithm>
#include <chrono>
#include <limits>
#include <optional>
#include <ostream>

namespace wend {
namespace {

using Clock = std::chrono::steady_clock;

/// Something to be done every so many seconds.
class Regularly {
public:
    explicit Regularly(double seconds) : seconds_(seconds) { restart(); }

    bool is_due() const { return seconds_ > 0 && left() <= 0; }
    /// Seconds until it is due.
    double left() const {
        return seconds_ > 0 ? seconds_ - std::chrono::duration<double>(Clock::now() - start_).count()
                            : std::numeric_limits<double>::infinity();
    }
    void restart() { start_ = Clock::now(); }

private:
    double seconds_;
    Clock::time_point start_;
};

/// Does what may fail without harm to the render; says so where it does, and returns false.
template <class Action>
bool attempt(const Streams& streams, const Action& action) {
    try {
        action();
        return true;
    } catch (const std::exception& error) {
        streams.err << "warning: " << error.what() << "; the render goes on\n" << std::flush;
        return false;
    }
}

/// What a render writes on its way: its picture and its checkpoint, when they are due. All ranks agree on when.
class FilesOnTheWay {
public:
    explicit FilesOnTheWay(const WatchOptions& options)
        : pictures_(options.write_every),
          checkpoints_(options.checkpoint.empty() ? 0 : options.checkpoint_every),
          has_picture_(options.write_every == 0) {}

    /// Seconds until the next is due.
    double left() const { return std::min(pictures_.left(), checkpoints_.left()); }

    /// Where one is due, all ranks share what they have, and the first writes it.
    template <class WritePicture, class WriteCheckpoint>
    void write(Render& render, const RenderProgress& progress, Team& team, const WritePicture& write_picture,
               const WriteCheckpoint& write_checkpoint) {
        // For the first picture: of a pass that takes longer there is a part.
        constexpr double longest_wait = 5;
        const bool is_first = team.rank() == 0;
        const bool writes_picture = team.agreed(
            pictures_.is_due() || (!has_picture_ && (progress.samples > 0 || progress.seconds > longest_wait)));
        const bool writes_checkpoint = team.agreed(checkpoints_.is_due());
        if (writes_picture || writes_checkpoint) {
            render.share();
        }
        if (writes_picture) {
            if (is_first) {
                write_picture();
            }
            has_picture_ = true;
            pictures_.restart();
        }
        if (writes_checkpoint) {
            if (is_first) {
                write_checkpoint();
            }
            checkpoints_.restart();
        }
    }

private:
    Regularly pictures_, checkpoints_;
    bool has_picture_;
};

/// Tells other programs of progress, where that is asked for.
void begin_lines(const WatchOptions& options, const Streams& streams, std::optional<ProgressLines>& lines) {
    if (!options.progress_file.empty()) {
        lines.emplace(options.progress_file);
    } else if (options.progress == "json") {
        lines.emplace(streams.err);
    }
}

}  // namespace

void WatchOptions::add_to(CLI::App& command) {
    command.add_option("--progress", progress, "how progress is shown: bar, json (a line each second) or none")
        ->check(CLI::IsMember({"bar", "json", "none"}))
        ->capture_default_str();
    command.add_option("--progress-file", progress_file, "write the lines of JSON to this file");
    command
        .add_option(
            "--write-every", write_every,
            "write the picture after the first pass, or 5 seconds, and every so many seconds, and not only at the end")
        ->check(seconds_problem);
    CLI::Option* file = command.add_option("--checkpoint", checkpoint,
                                           "keep in this file where the render is, so that it can be resumed");
    command.add_option("--checkpoint-every", checkpoint_every, "seconds between checkpoints")
        ->check(seconds_problem)
        ->capture_default_str()
        ->needs(file);
    command.add_option("--resume", resume, "go on from this checkpoint; scene and settings must be the same");
    live.add_to(command);
}

void WatchOptions::check() const {
    for (const std::string& file : {progress_file, checkpoint}) {
        if (!file.empty()) {
            require_writable(file);
        }
    }
}

RenderStatistics watched_render(const Session& session, Film& film, const RenderSettings& settings,
                                const WatchOptions& options, const CommonOptions& common, const Streams& streams,
                                const std::function<void(const RenderStatistics&)>& write_picture) {
    // The first rank alone looks at the clock, writes files and is watched.
    Team team(settings.ranks);
    const bool is_first = team.rank() == 0;
    std::optional<LiveView> view;
    if (options.live.any() && is_first) {
        view.emplace(options.live, session, settings.preset, streams);
    }
    Render render(session.scene(), film, view ? view->watched(settings) : settings);
    if (!options.resume.empty()) {
        resume_from(options.resume, render, session, settings);
    }
    std::optional<ProgressLines> lines;
    if (is_first) {
        begin_lines(options, streams, lines);
    }
    ProgressBar bar(streams.err, is_first && !common.quiet && options.progress == "bar",
                    std::filesystem::path(session.scene_file()).filename().string());
    FilesOnTheWay files(options);
    const auto write_now = [&] { attempt(streams, [&] { write_picture(render.statistics()); }); };
    const auto save_now = [&] {
        attempt(streams, [&] { save_checkpoint(options.checkpoint, render, session, settings); });
    };
    for (bool goes_on = true; goes_on;) {
        goes_on = render.step(std::clamp(files.left(), 0.0, seconds_between_looks));
        const RenderProgress progress = render.progress();
        bar.update(progress);
        if (lines && !attempt(streams, [&] { lines->update(progress); })) {
            lines.reset();
        }
        if (view) {
            view->update(render, film, write_now);
        }
        if (!goes_on || render.is_stopped()) {
            break;
        }
        files.write(render, progress, team, write_now, save_now);
    }
    const RenderStatistics statistics = render.result();
    if (!is_first) {
        return statistics;
    }
    const auto save_last = [&] {
        if (!options.checkpoint.empty()) {
            save_now();
        }
    };
    try {
        write_picture(statistics);
    } catch (...) {
        save_last();
        throw;
    }
    // Who reads that it is done looks for the picture.
    if (lines) {
        attempt(streams, [&] { lines->finish(render.progress(), !render.is_stopped()); });
    }
    // After the picture: it takes longer, and who stops a render may not wait for ever.
    save_last();
    if (view) {
        view->finish(render, film);
    }
    return statistics;
}

}  // namespace wend
