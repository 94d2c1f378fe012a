// How walks inside dense media are drawn.
#pragma once

#include <wend/render/learner.h>
#include <wend/transport/interior_recorder.h>
#include <wend/transport/subsurface_guides.h>

#include <utility>

namespace wend {

class InteriorLearner {
public:
    InteriorLearner(const LearningContext& context)
        : settings_(context.settings), guides_(context.scene, context.settings.subsurface, context.settings.threads) {}

    static constexpr bool steers = true;
    using Recorder = InteriorRecorder;
    struct Records {
        SecondMoments moments;
        std::vector<InteriorWalkRecord> walks;  ///< of the walk at hand
    };

    void begin(const PassPlan& plan) { records_ = plan.learns && !guides_.is_empty(); }
    bool records() const { return records_; }
    Recorder recorder(Records& records, bool /*is_recorded*/) const {
        return Recorder(records_ ? &records.walks : nullptr);
    }
    void keep(Records& records, bool /*is_recorded*/) const {
        for (const InteriorWalkRecord& walk : std::exchange(records.walks, {})) {
            guides_.count(walk, records.moments);
        }
    }
    void learn(std::vector<Records>& all, const PassPlan& plan) {
        SecondMoments moments;
        for (Records& tile : all) {
            moments += std::exchange(tile.moments, {});
        }
        const bool knows_field = settings_.preset.direction && plan.samples_after() >= warm_up_samples;
        const NextWalks next = plan.samples_after() >= settings_.training_samples ? NextWalks::rendering
                               : knows_field                                      ? NextWalks::beside_field
                                                                                  : NextWalks::beside_classical;
        guides_.learn(moments, next);
    }

    const SubsurfaceGuides& guides() const { return guides_; }

private:
    const RenderSettings& settings_;
    SubsurfaceGuides guides_;
    bool records_ = false;
};

static_assert(Learner<InteriorLearner>);

}  // namespace wend
