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
    using Records = TileRecords<ReflectionRecord>;

    void begin(const PassPlan& plan) { records_ = plan.learns && plan.steers; }
    bool records() const { return records_; }
    Recorder recorder(Records& records, bool is_recorded) const {
        return Recorder(records_ && is_recorded ? &records.begin_walk() : nullptr, probability_);
    }
    void keep(Records& records, bool /*is_recorded*/) const { records.end_walk(); }
    void learn(std::vector<Records>& all, const PassPlan& /*plan*/) {
        for (Records& tile : all) {
            probability_.add(std::exchange(tile, {}).all);
        }
        probability_.learn();
    }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& learner) {
        bytes(learner.probability_, learner.records_);
    }
    template <class Archive, class OfTile>
    void archive_records(Archive& bytes, OfTile& records) const {
        bytes(records);
        ReflectionProbability::check(bytes, records.all);
    }

    const ReflectionProbability& probability() const { return probability_; }

private:
    ReflectionProbability probability_;
    bool records_ = false;
};

static_assert(Learner<ReflectionLearner>);

}  // namespace wend
