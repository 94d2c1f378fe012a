// Shows a render to viewers, between its steps.
#pragma once

#include <wend/view/board.h>

#include <chrono>
#include <memory>
#include <string>

namespace wend {

/// Keeps a picture of the board as the render is. What it takes is little: pictures are made when somebody wants one,
/// and in no more than a fiftieth of the time.
class RenderView {
public:
    /// The board must outlive it.
    RenderView(Board& board, std::size_t index, std::string name);

    /// For RenderSettings::on_records of a render that is guided.
    void add(std::span<const guide::PathRecords> records) { records_->add(records); }
    /// Tells the board how far the render is. Not within a step of the render.
    void update(const Render& render, const Film& film, const RenderProgress& progress, const std::string& phase);

private:
    using Clock = std::chrono::steady_clock;

    bool is_due() const;

    Board& board_;
    std::size_t index_;
    std::shared_ptr<SharedRecords> records_ = std::make_shared<SharedRecords>();
    ShownPicture shown_;
    int samples_ = 0;           ///< that had ended when the fields were looked at
    Clock::time_point next_{};  ///< when a picture may be made again
    bool has_layers_ = false;
    bool is_last_ = false;  ///< whether the picture is that of a render that stands still
};

/// The phase of a render that goes on.
const char* phase_of(const RenderProgress& progress);

}  // namespace wend
