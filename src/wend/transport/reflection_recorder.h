// Records of what walks find behind boundaries, for the reflection probability.
#pragma once

#include <wend/transport/reflection_probability.h>
#include <wend/transport/walk_events.h>

#include <vector>

namespace wend {

class ReflectionRecorder {
public:
    /// Records nothing.
    ReflectionRecorder() = default;
    /// What was found behind boundaries is added.
    ReflectionRecorder(std::vector<ReflectionRecord>* records, const ReflectionProbability& probability)
        : records_(records), probability_(&probability) {}

    struct Branch {
        int boundary = ReflectionLog::none;  ///< the last one that was passed
    };
    Branch branch() const { return now_; }
    void resume(const Branch& branch) { now_ = branch; }
    void start() { log_.start(); }
    void finish() {
        if (records_) {
            log_.finish(*records_);
        }
    }

    void on(const walk_events::Contributed& event) { log_.bring(now_.boundary, event.light); }
    void on(const walk_events::PassedBoundary& event) {
        if (records_) {
            const auto& [sample, vertex, worth] = event;
            const bool reflected = dot(sample.direction, vertex.facing) > 0;
            now_.boundary = log_.note(now_.boundary, probability_->record(vertex.side(), reflected, 0), worth);
        }
    }

private:
    std::vector<ReflectionRecord>* records_ = nullptr;
    const ReflectionProbability* probability_ = nullptr;
    ReflectionLog log_;
    Branch now_;
};

}  // namespace wend
