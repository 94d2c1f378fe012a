// Renders of one scene that viewers watch side by side, each with as much time as the others.
#pragma once

#include <wend/app/session.h>
#include <wend/view/render_view.h>

#include <atomic>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace wend {

class LiveRenders {
public:
    /// One for each preset. `seconds` is the time that each has before it waits to be given more; 0: no end. `stop`
    /// ends steps. Session, board and `stop` must outlive it.
    LiveRenders(const Session& session, Board& board, const std::vector<std::string>& samplings, double seconds,
                const std::atomic<bool>& stop);
    ~LiveRenders();

    /// Whether any of them has something to do.
    bool is_busy() const;
    /// Goes on with the one that has had the least time, for a moment.
    void step();
    /// Does what a viewer asks for. `save` is given the index of a picture.
    void obey(const ViewCommand& command, const std::function<void(std::size_t)>& save);

    std::size_t size() const { return renders_.size(); }
    const std::string& sampling(std::size_t index) const;
    /// As `wend render` would write it.
    Picture picture(std::size_t index) const;

private:
    struct One;

    void show(std::size_t index);
    bool is_over(const One& one) const;

    const Session& session_;
    Board& board_;
    const std::atomic<bool>& stop_;
    double seconds_;
    bool is_paused_ = false;
    std::vector<std::unique_ptr<One>> renders_;
};

}  // namespace wend
