#pragma once

#include <wend/render/render.h>

#include <chrono>
#include <fstream>
#include <iosfwd>
#include <string>

namespace wend {

/// Tells other programs how far a render is: a line of JSON at most once a second, and one at the end. Keys:
/// `fraction`, `spp` and `noise` (null before it is known) after the last pass, `seconds`, `left` (seconds) and
/// `phase`, which is `learning`, `rendering`, `done` or `stopped`.
class ProgressLines {
public:
    /// To a stream.
    explicit ProgressLines(std::ostream& stream) : stream_(&stream) {}
    /// To a file, which is begun anew. Throws InputError where it cannot be written.
    explicit ProgressLines(const std::string& file);
    ProgressLines(const ProgressLines&) = delete;
    ProgressLines& operator=(const ProgressLines&) = delete;

    /// Both throw std::runtime_error where the file takes no more.
    void update(const RenderProgress& progress);
    void finish(const RenderProgress& progress, bool is_done);

private:
    void write(const RenderProgress& progress, const char* phase);

    std::string name_;  ///< of the file; empty: there is none
    std::ofstream file_;
    std::ostream* stream_;
    std::chrono::steady_clock::time_point next_ = std::chrono::steady_clock::now();
};

}  // namespace wend
