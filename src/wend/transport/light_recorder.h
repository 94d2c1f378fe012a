// Records of connections to lights, for light selection.
#pragma once

#include <wend/light/light_selection.h>
#include <wend/transport/walk_events.h>

#include <vector>

namespace wend {

class LightRecorder {
public:
    /// Records nothing.
    LightRecorder() = default;
    /// What connections brought is added.
    LightRecorder(std::vector<LightRecord>* records, const LightSelection& selection)
        : records_(records), selection_(&selection) {}

    struct Branch {};
    Branch branch() const { return {}; }
    void resume(const Branch&) {}
    void start() {}
    void finish() {}

    void on(const walk_events::Connected& event) {
        if (records_) {
            records_->push_back(
                selection_->record(event.vertex.receiver(), event.light,
                                   mean_value(event.contribution) * event.times * event.choice_probability));
        }
    }

private:
    std::vector<LightRecord>* records_ = nullptr;
    const LightSelection* selection_ = nullptr;
};

}  // namespace wend
