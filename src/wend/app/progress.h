#pragma once

#include <wend/render/render.h>

#include <chrono>
#include <iosfwd>
#include <optional>
#include <string>

namespace wend {

/// Shows how far long work is: a bar that redraws itself on a terminal, a line now and then elsewhere, nothing where
/// disabled.
class ProgressBar {
public:
    ProgressBar(std::ostream& stream, bool enabled, std::string label);
    ~ProgressBar();
    ProgressBar(const ProgressBar&) = delete;
    ProgressBar& operator=(const ProgressBar&) = delete;

    /// `fraction` of the work took `seconds`; `detail` follows the time left.
    void update(double fraction, double seconds, const std::string& detail);
    void update(const RenderProgress& progress);

private:
    std::ostream& stream_;
    bool enabled_;
    bool terminal_;
    std::string label_;
    std::chrono::steady_clock::time_point last_;
    bool drawn_ = false;
};

/// Shows renders one after the other: a bar for each, which begins with a progress of 0 seconds.
class ProgressOfRenders {
public:
    ProgressOfRenders(std::ostream& stream, bool enabled) : stream_(stream), enabled_(enabled) {}

    void update(const std::string& label, const RenderProgress& progress) {
        if (progress.seconds == 0) {
            bar_.emplace(stream_, enabled_, label);
        } else {
            bar_->update(progress);
        }
    }

private:
    std::ostream& stream_;
    bool enabled_;
    std::optional<ProgressBar> bar_;
};

/// "1:05" or "2:03:04".
std::string format_duration(double seconds);

}  // namespace wend
