#include <wend/app/live_renders.h>

#include <algorithm>
#include <chrono>
#include <utility>

namespace wend {
namespace {

using Clock = std::chrono::steady_clock;

// How soon what viewers ask for is noticed.
constexpr double step_seconds = 0.2;

RenderSettings settings_of(const Session& session, const std::string& sampling, RenderView& view,
                           const std::atomic<bool>& stop) {
    RenderSettings settings = session.settings();
    settings.preset = parse_preset(sampling);
    settings.samples = RenderSettings::most_samples;
    settings.stop = &stop;
    if (!settings.preset.is_classical()) {
        settings.on_records = [&view](std::span<const guide::PathRecords> records) { view.add(records); };
    }
    return settings;
}

}  // namespace

struct LiveRenders::One {
    One(const Session& session, Board& board, std::size_t index, std::string name, const std::atomic<bool>& stop)
        : sampling(std::move(name)),
          film(session.new_film(session.settings())),
          view(board, index, sampling),
          settings(settings_of(session, sampling, view, stop)),
          render(session.scene(), film, settings) {}

    std::string sampling;
    Film film;
    RenderView view;
    RenderSettings settings;
    Render render;
    double seconds = 0;  ///< of its own steps
};

LiveRenders::LiveRenders(const Session& session, Board& board, const std::vector<std::string>& samplings,
                         double seconds, const std::atomic<bool>& stop)
    : session_(session), board_(board), stop_(stop), seconds_(seconds) {
    for (const std::string& sampling : samplings) {
        renders_.push_back(std::make_unique<One>(session, board, renders_.size(), sampling, stop));
    }
    for (std::size_t i = 0; i < renders_.size(); ++i) {
        show(i);
    }
}

LiveRenders::~LiveRenders() = default;

bool LiveRenders::is_over(const One& one) const {
    return seconds_ > 0 && one.seconds >= seconds_;
}

bool LiveRenders::is_busy() const {
    return !is_paused_ &&
           std::any_of(renders_.begin(), renders_.end(), [&](const auto& one) { return !is_over(*one); });
}

void LiveRenders::step() {
    const auto next = std::min_element(renders_.begin(), renders_.end(),
                                       [](const auto& a, const auto& b) { return a->seconds < b->seconds; });
    One& one = **next;
    const Clock::time_point start = Clock::now();
    one.render.step(seconds_ > 0 ? std::min(step_seconds, seconds_ - one.seconds) : step_seconds);
    one.seconds += std::chrono::duration<double>(Clock::now() - start).count();
    show(static_cast<std::size_t>(next - renders_.begin()));
}

void LiveRenders::show(std::size_t index) {
    One& one = *renders_[index];
    // The render's own clock runs on while it waits.
    RenderProgress progress = one.render.progress();
    progress.seconds = one.seconds;
    progress.seconds_left = seconds_ > 0 ? std::max(0.0, seconds_ - one.seconds) : 0.0;
    progress.fraction = seconds_ > 0 ? std::min(1.0, one.seconds / seconds_) : 0.0;
    const char* phase = is_over(one) ? "done" : is_paused_ ? "paused" : phase_of(progress);
    one.view.update(one.render, one.film, progress, phase);
}

void LiveRenders::obey(const ViewCommand& command, const std::function<void(std::size_t)>& save) {
    switch (command.kind) {
        case ViewCommand::Kind::pause:
            is_paused_ = true;
            break;
        case ViewCommand::Kind::go_on:
            is_paused_ = false;
            break;
        case ViewCommand::Kind::more_seconds:
            seconds_ += seconds_ > 0 ? command.seconds : 0;
            break;
        case ViewCommand::Kind::restart:
            renders_[command.picture] =
                std::make_unique<One>(session_, board_, command.picture, command.sampling, stop_);
            break;
        case ViewCommand::Kind::save:
            for (std::size_t i = 0; i < renders_.size(); ++i) {
                save(i);
            }
            break;
        case ViewCommand::Kind::stop:
            break;
    }
    for (std::size_t i = 0; i < renders_.size(); ++i) {
        show(i);
    }
}

const std::string& LiveRenders::sampling(std::size_t index) const {
    return renders_[index]->sampling;
}

Picture LiveRenders::picture(std::size_t index) const {
    const One& one = *renders_[index];
    RenderStatistics statistics = one.render.statistics();
    statistics.seconds = one.seconds;
    return session_.picture(one.film, one.settings, statistics);
}

}  // namespace wend
