// All that is learned between passes.
#pragma once

#include <wend/render/field_learner.h>
#include <wend/render/interior_learner.h>
#include <wend/render/light_learner.h>
#include <wend/render/reflection_learner.h>
#include <wend/transport/walk_recorder.h>

#include <tuple>
#include <utility>
#include <vector>

namespace wend {

/// Learners beside each other.
template <Learner... Each>
class LearnerList {
public:
    explicit LearnerList(const LearningContext& context) : learners_((static_cast<void>(sizeof(Each)), context)...) {}

    using Records = std::tuple<typename Each::Records...>;
    using Recorders = WalkRecorder<typename Each::Recorder...>;

    void begin(const PassPlan& plan) {
        std::apply([&](auto&... each) { (each.begin(plan), ...); }, learners_);
    }
    /// Whether any by which walks go records the pass: the next one will go otherwise.
    bool changes_walks() const { return ((Each::steers && get<Each>().records()) || ...); }
    Recorders recorders(Records& records, bool is_recorded) const {
        return Recorders(get<Each>().recorder(std::get<typename Each::Records>(records), is_recorded)...);
    }
    void keep(Records& records, bool is_recorded) const {
        (get<Each>().keep(std::get<typename Each::Records>(records), is_recorded), ...);
    }
    /// From the records of all tiles, which are given up.
    void learn(std::vector<Records>& tiles, const PassPlan& plan) { (learn<Each>(tiles, plan), ...); }

    /// What each knows; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& list) {
        std::apply([&](auto&... each) { bytes(each...); }, list.learners_);
    }
    template <class Archive, class OfTile>
    void archive_records(Archive& bytes, OfTile& records) const {
        (get<Each>().archive_records(bytes, std::get<typename Each::Records>(records)), ...);
    }

    template <class L>
    const L& get() const {
        return std::get<L>(learners_);
    }
    template <class L>
    L& get() {
        return std::get<L>(learners_);
    }

private:
    template <class L>
    void learn(std::vector<Records>& tiles, const PassPlan& plan) {
        L& learner = get<L>();
        if (!learner.records()) {
            return;
        }
        std::vector<typename L::Records> all;
        for (Records& tile : tiles) {
            all.push_back(std::exchange(std::get<typename L::Records>(tile), {}));
        }
        learner.learn(all, plan);
    }

    std::tuple<Each...> learners_;
};

/// Those of render().
using Learners = LearnerList<FieldLearner, InteriorLearner, LightLearner, ReflectionLearner>;

}  // namespace wend
