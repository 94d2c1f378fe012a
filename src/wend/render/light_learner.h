// Which lights vertices are connected to.
#pragma once

#include <wend/render/learner.h>
#include <wend/render/schedule.h>
#include <wend/transport/light_recorder.h>

#include <utility>

namespace wend {

class LightLearner {
public:
    LightLearner(const LearningContext& context)
        : settings_(context.settings),
          selection_(context.scene),
          has_a_turn_for_each_(context.settings.sampler == SamplerKind::sobol &&
                               static_cast<int>(context.scene.lights().size()) <= Schedule(context.settings).total()) {}

    static constexpr bool steers = true;
    using Recorder = LightRecorder;
    using Records = TileRecords<LightRecord>;

    void begin(const PassPlan& plan) {
        // Low-discrepancy samples take few lights in turn, without noise of the choice. Other probabilities from the
        // second sample on would leave the first one by itself, which no short render makes up for.
        const bool takes_turns = !plan.is_of_guided_render && has_a_turn_for_each_;
        records_ = plan.learns && settings_.preset.direction && selection_.learns() && !takes_turns;
    }
    bool records() const { return records_; }
    Recorder recorder(Records& records, bool is_recorded) const {
        return Recorder(records_ && is_recorded ? &records.begin_walk() : nullptr, selection_);
    }
    void keep(Records& records, bool /*is_recorded*/) const { records.end_walk(); }
    void learn(std::vector<Records>& all, const PassPlan& /*plan*/) {
        for (Records& tile : all) {
            selection_.add(std::exchange(tile, {}).all);
        }
        selection_.learn(settings_.threads);
    }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& learner) {
        bytes(learner.selection_, learner.records_);
    }
    template <class Archive, class OfTile>
    void archive_records(Archive& bytes, OfTile& records) const {
        bytes(records);
        selection_.check(bytes, records.all);
    }

    const LightSelection& selection() const { return selection_; }

private:
    const RenderSettings& settings_;
    LightSelection selection_;
    bool has_a_turn_for_each_;  ///< whether samples can take the lights in turn
    bool records_ = false;
};

static_assert(Learner<LightLearner>);

}  // namespace wend
