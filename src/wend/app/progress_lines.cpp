#include <wend/app/progress_lines.h>

#include <wend/app/options.h>
#include <wend/core/error.h>

#include <nlohmann/json.hpp>

#include <cerrno>
#include <cstring>
#include <ostream>
#include <stdexcept>

namespace wend {

ProgressLines::ProgressLines(const std::string& file) : name_(file), stream_(&file_) {
    errno = 0;
    file_.open(file, std::ios::trunc);
    if (!file_) {
        throw InputError(Place{file}, std::string("cannot be written: ") + std::strerror(errno));
    }
}

void ProgressLines::update(const RenderProgress& progress) {
    const auto now = std::chrono::steady_clock::now();
    if (now >= next_) {
        write(progress, progress.learns ? "learning" : "rendering");
        next_ = now + std::chrono::seconds(1);
    }
}

void ProgressLines::finish(const RenderProgress& progress, bool is_done) {
    write(progress, is_done ? "done" : "stopped");
}

void ProgressLines::write(const RenderProgress& progress, const char* phase) {
    const nlohmann::json line = {
        {"fraction", progress.fraction},
        {"spp", progress.samples},
        {"noise", progress.relative_noise > 0 ? nlohmann::json(progress.relative_noise) : nlohmann::json(nullptr)},
        {"seconds", progress.seconds},
        {"left", progress.seconds_left},
        {"phase", phase}};
    errno = 0;
    *stream_ << json_text(line) << '\n' << std::flush;
    // Where the standard error has gone, there is nobody to be told.
    if (!*stream_ && !name_.empty()) {
        throw std::runtime_error(name_ + ": cannot write: " + std::strerror(errno));
    }
}

}  // namespace wend
