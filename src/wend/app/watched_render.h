// A render by the command line, which shows how far it is, writes pictures and checkpoints on its way, and can be
// stopped and resumed.
#pragma once

#include <wend/app/live_view.h>
#include <wend/app/options.h>
#include <wend/app/session.h>
#include <wend/render/render.h>

#include <filesystem>
#include <functional>
#include <string>

namespace wend {

struct WatchOptions {
    std::string progress = "bar";
    std::string progress_file;
    double write_every = 0;  ///< seconds; 0: only at the end
    std::string checkpoint;
    double checkpoint_every = 60;
    std::string resume;
    LiveViewers live;

    void add_to(CLI::App& command);
    /// Throws InputError for files that cannot be written.
    void check() const;
};

/// Renders into the film until it is done or InterruptGuard is told to stop, which `settings.stop` refers to.
/// `write_picture` is called at the end, and on the way: what fails there is told and tried again.
RenderStatistics watched_render(const Session& session, Film& film, const RenderSettings& settings,
                                const WatchOptions& options, const CommonOptions& common, const Streams& streams,
                                const std::function<void(const RenderStatistics&)>& write_picture);

}  // namespace wend
