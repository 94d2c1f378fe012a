// Records of walks for the learned fields.
#pragma once

#include <wend/guide/path_log.h>
#include <wend/transport/walk_events.h>

namespace wend {

/// Writes the log that training records are made of.
class FieldRecorder {
public:
    /// Records nothing.
    FieldRecorder() = default;
    /// The log is started anew.
    explicit FieldRecorder(guide::PathLog* log) : log_(log) {}

    struct Branch {
        guide::PathLog::Branch path{};
        bool is_logged = true;  ///< whether the log has collisions of this interior walk
    };
    Branch branch() const { return {log_ ? log_->branch() : guide::PathLog::Branch{}, is_logged_}; }
    void resume(const Branch& branch) {
        is_logged_ = branch.is_logged;
        if (log_) {
            log_->resume(branch.path);
        }
    }
    void start() {
        if (log_) {
            log_->start();
        }
    }
    void finish() {}

    void on(const walk_events::Weighed& event) {
        if (log_) {
            log_->weigh(event.weight);
        }
    }
    void on(const walk_events::MetLight& event) {
        if (log_) {
            log_->gather(event.radiance);
        }
    }
    void on(const walk_events::MetEmission& event) {
        if (log_) {
            log_->glow(event.radiance, event.distance);
        }
    }
    void on(const walk_events::Arrived& event) {
        if (log_) {
            log_->meet(event.travelled);
        }
    }
    void on(const walk_events::HitSurface& event) {
        if (log_) {
            log_->face(event.vertex.facing);
        }
    }
    void on(const walk_events::Scattered& event);
    void on(const walk_events::Connected& event);
    void on(const walk_events::ConnectedAhead& event);
    void on(const walk_events::EnteredMedium& event);

private:
    guide::PathLog* log_ = nullptr;
    bool is_logged_ = true;
};

}  // namespace wend
