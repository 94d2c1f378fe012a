// All that is learned between passes.
#pragma once

#include <wend/render/field_learner.h>
#include <wend/render/interior_learner.h>
#include <wend/render/light_learner.h>
#include <wend/render/reflection_learner.h>
#include <wend/transport/walk_recorder.h>

#include <cstddef>
#include <tuple>
#include <type_traits>
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
    /// From the records of all tiles, which are given up. Each process brings those of its own.
    void learn(std::vector<Records>& tiles, const PassPlan& plan, TileShares& shares) {
        (learn<Each>(tiles, plan, shares), ...);
    }

    /// What each knows; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& list) {
        std::apply([&](auto&... each) { bytes(each...); }, list.learners_);
    }
    /// The same of all but those for which LearnsTogether holds: what guide::Fields do not have.
    template <class Archive, class Self>
    static void archive_beside_fields(Archive& bytes, Self& list) {
        const auto one = [&](auto& learner) {
            if constexpr (!LearnsTogether<std::remove_cvref_t<decltype(learner)>>) {
                bytes(learner);
            }
        };
        std::apply([&](auto&... each) { (one(each), ...); }, list.learners_);
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
    void learn(std::vector<Records>& tiles, const PassPlan& plan, TileShares& shares) {
        L& learner = get<L>();
        if (!learner.records()) {
            return;
        }
        std::vector<typename L::Records> all;
        for (Records& tile : tiles) {
            all.push_back(std::exchange(std::get<typename L::Records>(tile), {}));
        }
        if constexpr (LearnsTogether<L>) {
            for (std::size_t i = 0; i < all.size(); ++i) {
                // What other processes sent before is theirs to bring.
                all[i] = shares.owns(i) ? std::move(all[i]) : typename L::Records();
            }
            learner.learn(all, plan, shares);
        } else {
            shares.gather([&](auto& bytes, std::size_t i) { learner.archive_records(bytes, all[i]); });
            learner.learn(all, plan);
        }
    }

    std::tuple<Each...> learners_;
};

/// Those of render().
using Learners = LearnerList<FieldLearner, InteriorLearner, LightLearner, ReflectionLearner>;

}  // namespace wend
