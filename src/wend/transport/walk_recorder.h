// What a walk says of itself to those that learn from walks.
#pragma once

#include <tuple>
#include <utility>

namespace wend {

/// A walk says once what happens to it (transport/walk_events.h) and need not know who records it. A recorder has a
/// function on() for each event that it takes, and a `Branch`: its state, which a walk that is split goes back to. A
/// recorder may draw random numbers; what the walk estimates is the same.
template <class... Recorders>
class WalkRecorder {
public:
    WalkRecorder() = default;
    explicit WalkRecorder(Recorders... recorders) : recorders_(std::move(recorders)...) {}

    using Branch = std::tuple<typename Recorders::Branch...>;
    Branch branch() const {
        return std::apply([](const auto&... each) { return Branch(each.branch()...); }, recorders_);
    }
    void resume(const Branch& branch) { resume(branch, std::index_sequence_for<Recorders...>()); }

    /// A walk begins.
    void start() {
        std::apply([](auto&... each) { (each.start(), ...); }, recorders_);
    }
    /// It has ended, with all its branches.
    void finish() {
        std::apply([](auto&... each) { (each.finish(), ...); }, recorders_);
    }

    template <class Event>
    void record(const Event& event) {
        static_assert((takes<Recorders, Event> || ...), "nobody records this");
        std::apply([&](auto&... each) { (give(each, event), ...); }, recorders_);
    }

    template <class Recorder>
    Recorder& get() {
        return std::get<Recorder>(recorders_);
    }
    template <class Recorder>
    const Recorder& get() const {
        return std::get<Recorder>(recorders_);
    }

private:
    template <class Recorder, class Event>
    static constexpr bool takes = requires(Recorder& recorder, const Event& event) {
        recorder.on(event);
    };

    template <class Recorder, class Event>
    static void give(Recorder& recorder, const Event& event) {
        if constexpr (takes<Recorder, Event>) {
            recorder.on(event);
        }
    }
    template <std::size_t... i>
    void resume(const Branch& branch, std::index_sequence<i...>) {
        (std::get<i>(recorders_).resume(std::get<i>(branch)), ...);
    }

    std::tuple<Recorders...> recorders_;
};

}  // namespace wend
