// Learning between passes: what all learners have in common.
#pragma once

#include <wend/core/archive.h>
#include <wend/render/render.h>
#include <wend/render/tile_shares.h>
#include <wend/scene/scene.h>

#include <algorithm>
#include <concepts>
#include <cstdint>
#include <type_traits>
#include <variant>
#include <vector>

namespace wend {

/// Before, neither the fields nor the pixels are known well enough to judge guides by them.
inline constexpr int warm_up_samples = 7;

/// Whether there is a medium where free flights can be guided.
inline bool has_fog(const Scene& scene) {
    const std::vector<Medium>& media = scene.description().media;
    return std::any_of(media.begin(), media.end(), [](const Medium& medium) {
        return std::holds_alternative<HomogeneousMedium>(medium) && scatters(medium);
    });
}

/// What one pass does.
struct PassPlan {
    int first = 0;  ///< sample of each pixel, as a mean
    int count = 0;  ///< of samples, as a mean
    /// Whether the render is long enough for walks that follow the fields.
    bool is_of_guided_render = false;
    /// Of each pixel of the crop: the first of its samples, and how many follow; empty where all have as many.
    std::vector<std::uint32_t> firsts, counts;
    bool learns = false;        ///< whether walks are there to learn from
    bool fills_fields = false;  ///< whether the fields learn from them, too
    bool guides = false;        ///< whether any walk may be guided
    bool steers = false;        ///< whether where walks go is guided: by the fields, or inside dense media
    double recorded_share = 1;  ///< of the walks, those that are recorded
    /// The same, of walks that take directions from the fields. Where light is hard to find they bring most of it.
    double recorded_share_directed = 1;
    double recorded_walks = 0;  ///< that many, as a mean
    /// Of each pixel of the crop, without exposure; empty where not known.
    std::vector<float> estimates;
    double mean_estimate = 0;    ///< of all pixels; 0 where estimates are not known
    double sample_variance = 0;  ///< of one sample, relative to its pixel; 0 where estimates are not known

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& plan) {
        bytes(plan.first, plan.count, plan.firsts, plan.counts, plan.is_of_guided_render, plan.learns,
              plan.fills_fields, plan.guides, plan.steers, plan.recorded_share, plan.recorded_share_directed,
              plan.recorded_walks, plan.estimates, plan.mean_estimate, plan.sample_variance);
    }

    /// Samples of each pixel once the pass has ended.
    int samples_after() const { return first + count; }
};

/// What a render is, for those that learn from it. What it refers to must outlive them.
struct LearningContext {
    const Scene& scene;
    const RenderSettings& settings;
    double pixels;

    double walks(const PassPlan& plan) const { return pixels * plan.count; }
};

/// What walks in a tile have left. A walk may be dropped on its way: what it left is forgotten when the next begins.
template <class T>
struct TileRecords {
    std::vector<T> all;
    std::size_t kept = 0;  ///< the first ones, of walks that have ended

    std::vector<T>& begin_walk() {
        all.erase(all.begin() + static_cast<std::ptrdiff_t>(kept), all.end());
        return all;
    }
    void end_walk() { kept = all.size(); }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& records) {
        if constexpr (std::is_const_v<Self>) {
            bytes(std::vector<T>(records.all.begin(), records.all.begin() + static_cast<std::ptrdiff_t>(records.kept)));
        } else {
            bytes(records.all);
            records.end_walk();
        }
    }
};

/// Learns from the records that each of several processes has of its own tiles, the same in all of them.
template <class L>
concept LearnsTogether = requires(L& learner, std::vector<typename L::Records>& mine, const PassPlan& plan,
                                  TileShares& shares) {
    learner.learn(mine, plan, shares);
};

/// A learner is made from a LearningContext. Its records are kept apart by tile. Its recorder, one of transport's, puts
/// into them what a walk meets; keep() is called once the walk has ended, and says whether it counts as recorded. A
/// walk that is dropped has no keep(). What it knows changes in learn() alone, after a pass, with the records of all
/// tiles in their order; of several processes each gets them all, unless it LearnsTogether. Records are told apart by
/// their type, which is each learner's own. What it knows and records can be archived, so that a render can be resumed.
template <class L>
concept Learner = requires(L& learner, const L& known, typename L::Records& records,
                           std::vector<typename L::Records>& all, const PassPlan& plan) {
    requires std::is_constructible_v<L, const LearningContext&>;
    learner.begin(plan);
    /// Whether this pass is recorded.
    { known.records() } -> std::same_as<bool>;
    /// Whether walks go by what it knows. A pass that changes that begins a new stage of the film.
    { L::steers } -> std::convertible_to<bool>;
    { known.recorder(records, true) } -> std::same_as<typename L::Recorder>;
    known.keep(records, true);
    requires LearnsTogether<L> || requires {
        learner.learn(all, plan);
    };
    requires ListsMembers<const L, ArchiveWriter> && ListsMembers<L, ArchiveReader>;
    known.archive_records(std::declval<ArchiveReader&>(), records);
    known.archive_records(std::declval<ArchiveWriter&>(), std::as_const(records));
};

}  // namespace wend
