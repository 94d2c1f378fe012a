// A path with its branches, which says what happens to it.
#pragma once

#include <wend/light/emitter_hit.h>
#include <wend/transport/light_parts.h>
#include <wend/transport/path_state.h>
#include <wend/transport/walk_events.h>

#include <utility>
#include <variant>
#include <vector>

namespace wend {

/// The branch at hand, those that are pending, and the light that all of them have brought. Every factor and every
/// radiance passes through here, to the recorders as well.
template <class Recorders>
class BranchingPath {
public:
    /// `parts` may be null.
    BranchingPath(Recorders recorders, LightParts* parts) : recorder_(std::move(recorders)), parts_(parts) {}

    /// The branch at hand.
    PathState now;

    const Rgb& radiance() const { return radiance_; }
    /// WalkResult::unguided_square.
    double unguided_square() const { return unguided_square_; }

    void start() {
        recorder_.start();
        if (parts_) {
            parts_->start();
        }
    }
    void finish() { recorder_.finish(); }
    template <class Event>
    void record(const Event& event) {
        recorder_.record(event);
    }
    /// The answer of the technique at hand.
    template <class Question>
    decltype(auto) ask_technique(Question&& question) {
        return std::visit(question, now.interior.technique);
    }

    void weigh(const Rgb& weight) {
        now.weight.throughput *= weight;
        record(walk_events::Weighed{weight});
    }
    /// Light that the path runs into, before its weight is counted.
    void meet(const EmitterHit& hit) {
        if (!is_black(hit.radiance)) {
            gather(hit.radiance, {.hit = &hit, .last = &now.last});
        }
    }
    void gather(const Rgb& radiance, const walk_events::LightFound& found) {
        bring(now.weight.throughput * radiance, found);
        record(walk_events::MetLight{radiance});
    }
    /// A medium's own, from this mean distance.
    void glow(const Rgb& radiance, float distance) {
        bring(now.weight.throughput * radiance, {});
        record(walk_events::MetEmission{radiance, distance});
    }
    /// Light with its weight.
    void bring(const Rgb& light, const walk_events::LightFound& found) {
        radiance_ += light;
        count_unguided(mean_value(light));
        record(walk_events::Contributed{mean_value(light), now.interior.technique, found});
    }

    /// Sorts light, before its weight is counted, that the path brings in one of the ways above, or is a part of that.
    void sort(const Rgb& radiance, const LightOrigin& origin) {
        if (parts_) {
            parts_->add(now.weight.throughput * radiance, now.counts, origin);
        }
    }

    struct Branch {
        PathState state;
        typename Recorders::Branch recorded;
    };
    Branch branch() const { return {now, recorder_.branch()}; }
    void go_on_from(const Branch& branch) {
        now = branch.state;
        recorder_.resume(branch.recorded);
    }
    void leave_pending() { pending_.push_back(branch()); }
    bool take_up_pending() {
        if (pending_.empty()) {
            return false;
        }
        go_on_from(pending_.back());
        pending_.pop_back();
        return true;
    }
    /// Of the branch at hand, how many there may be.
    int split_capacity() const { return 1 + max_pending - static_cast<int>(pending_.size()); }

private:
    static constexpr int max_pending = 64;

    /// An unguided path has no branches. Had it gone as this one has, it would have brought unguided_ratio() times as
    /// much, and that would have been less often by as much. So the square of what it brings, which is the sum of what
    /// each light on the way adds to it, is a mean over the branches of guided ones.
    void count_unguided(float brought) {
        if (brought == 0) {
            return;
        }
        const float unguided = brought * now.weight.unguided_ratio();
        unguided_square_ += static_cast<double>(brought) * (2 * now.weight.unguided + unguided);
        now.weight.unguided += unguided;
    }

    Recorders recorder_;
    LightParts* parts_;
    std::vector<Branch> pending_;
    Rgb radiance_;
    double unguided_square_ = 0;
};

}  // namespace wend
