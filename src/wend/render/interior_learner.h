// How walks inside dense media are drawn.
#pragma once

#include <wend/render/learner.h>
#include <wend/transport/interior_recorder.h>
#include <wend/transport/subsurface_guides.h>

#include <cstddef>
#include <utility>
#include <vector>

namespace wend {

class InteriorLearner {
public:
    InteriorLearner(const LearningContext& context)
        : context_(context),
          can_guide_(!context.settings.subsurface.is_classical() && SubsurfaceGuides::has_dense_medium(context.scene)) {
    }

    static constexpr bool steers = true;
    using Recorder = InteriorRecorder;
    struct Records {
        SecondMoments moments;
        std::vector<InteriorWalkRecord> walks;  ///< of the walk at hand
    };

    /// Explores the media once they are to be guided.
    void begin(const PassPlan& plan) {
        if (plan.guides) {
            explore();
        }
        records_ = plan.learns && !guides_.is_empty();
    }
    bool records() const { return records_; }
    Recorder recorder(Records& records, bool /*is_recorded*/) const {
        records.walks.clear();
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
        const bool knows_field = context_.settings.preset.direction && plan.samples_after() >= warm_up_samples;
        const NextWalks next = plan.samples_after() >= context_.settings.training_samples ? NextWalks::rendering
                               : knows_field                                              ? NextWalks::beside_field
                                                                                          : NextWalks::beside_classical;
        guides_.learn(moments, next);
    }

    /// Whether there is a dense medium to be guided.
    bool can_guide() const { return can_guide_; }
    const SubsurfaceGuides& guides() const { return guides_; }

    /// Of the media of the scene, those that are guided once they have been explored.
    std::vector<int> dense_media() const {
        std::vector<int> dense;
        for (std::size_t i = 0; !guides_.is_empty() && i < context_.scene.description().media.size(); ++i) {
            const auto medium = static_cast<MediumId>(i);
            if (guides_.plan(medium, Vec3(0, 0, 0))) {
                dense.push_back(medium);
            }
        }
        return dense;
    }
    /// Explores the media; whether these are the dense ones.
    bool has_dense_media(const std::vector<int>& dense) {
        explore();
        return dense_media() == dense;
    }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& learner) {
        bool has_explored = !learner.guides_.is_empty();
        bytes(has_explored);
        if constexpr (!std::is_const_v<Self>) {
            if (has_explored) {
                learner.explore();
            }
        }
        bytes(learner.guides_, learner.records_);
    }
    template <class Archive, class OfTile>
    void archive_records(Archive& bytes, OfTile& records) const {
        bytes(records.moments);
        guides_.check(bytes, records.moments);
    }

private:
    void explore() {
        if (can_guide_ && guides_.is_empty()) {
            guides_ = SubsurfaceGuides(context_.scene, context_.settings.subsurface);
        }
    }

    LearningContext context_;
    bool can_guide_;
    SubsurfaceGuides guides_;
    bool records_ = false;
};

static_assert(Learner<InteriorLearner>);

}  // namespace wend
