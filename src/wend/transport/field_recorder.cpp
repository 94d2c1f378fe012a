#include <wend/transport/field_recorder.h>

#include <limits>

namespace wend {

using namespace walk_events;

void FieldRecorder::on(const Scattered& event) {
    if (!log_) {
        return;
    }
    const auto& [s, v, throughput] = event;
    if (v.in_volume() && !is_logged_) {
        log_->weigh(s.weight());
    } else {
        log_->scatter(v.position, s.direction, s.specular ? 0 : s.density, s.weight(), v.in_volume(),
                      s.classical_density, s.guided_density);
    }
    // In a channel without throughput the walk draws nothing, and what it finds there says nothing.
    log_->weigh({throughput.r > 0 ? 1.0f : 0.0f, throughput.g > 0 ? 1.0f : 0.0f, throughput.b > 0 ? 1.0f : 0.0f});
}

void FieldRecorder::on(const Connected& event) {
    if (log_ && (is_logged_ || !event.vertex.in_volume())) {
        log_->connect(event.to_light, event.distance, event.fluence, event.contribution);
    }
}

void FieldRecorder::on(const ConnectedAhead& event) {
    if (!log_) {
        return;
    }
    log_->gather(event.contribution);
    if (is_logged_) {
        log_->connect(event.direction, std::numeric_limits<float>::infinity(),
                      mean_value(event.contribution) / mean_value(event.phase), event.contribution);
    }
}

void FieldRecorder::on(const EnteredMedium& event) {
    is_logged_ = !log_ || !event.guided || event.random.uniform() < event.recording_probability;
}

}  // namespace wend
