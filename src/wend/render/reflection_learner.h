// How often boundaries reflect.
#pragma once

#include <wend/render/learner.h>
#include <wend/transport/reflection_recorder.h>

#include <utility>

namespace wend {

class ReflectionLearner {
public:
    ReflectionLearner(const LearningContext& context) : probability_(context.scene.bounds()) {}

    static constexpr bool steers = true;
    using Recorder = ReflectionRecorder;
    using Records = std::vector<ReflectionRecord>;

    void begin(const PassPlan& plan) { records_ = plan.learns && plan.steers; }
    bool records() const { return records_; }
    Recorder recorder(Records& records, bool is_recorded) const {
        return Recorder(records_ && is_recorded ? &records : nullptr, probability_);
    }
    void keep(Records&, bool /*is_recorded*/) const {}
    void learn(std::vector<Records>& all, const PassPlan& /*plan*/) {
        for (Records& tile : all) {
            probability_.add(std::exchange(tile, {}));
        }
        probability_.learn();
    }

    const ReflectionProbability& probability() const { return probability_; }

private:
    ReflectionProbability probability_;
    bool records_ = false;
};

static_assert(Learner<ReflectionLearner>);

}  // namespace wend
