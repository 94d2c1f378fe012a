// Which ways to sample an interior walk in a dense medium pay, by the place where it begins: learned from what interior
// walks brought.
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/subsurface/interior_walk_record.h>
#include <wend/subsurface/second_moments.h>
#include <wend/subsurface/technique_mix.h>

#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace wend {

/// Plans in a grid of cells, for the interior walks in one medium. Any number of threads may ask; none while it learns.
class WEND_API TechniqueMixes {
public:
    /// Of a medium in this box. `defensive_fraction`, in (0, 1], is the share of classical sampling to begin with.
    TechniqueMixes(const Box3& box, float defensive_fraction);

    /// The cell of an interior walk that begins at a point, finite; points outside of the box belong to the closest
    /// one.
    int cell_at(const Vec3& entry) const;
    /// How many there are.
    int cells() const { return static_cast<int>(plans_.size()); }
    /// How interior walks that begin in a cell are drawn.
    const TechniqueMix& plan(int cell) const { return plans_[static_cast<std::size_t>(cell)]; }
    /// The interior walk with what it brought over what is expected in its cell, as errors of a picture count relative
    /// to it, but no more than SecondMoments::most_expected. What moments are to be made of.
    InteriorWalkRecord relative(const InteriorWalkRecord& interior_walk) const;

    /// `moments` by cell, of relative() interior walks. Moves the logarithms of each share, and of the preference, down
    /// the slope of the second moment relative to the variance of F, as far as the slope is significant. Cells that few
    /// interior walks began in follow all others. Where no connection has ever succeeded, behind a boundary that
    /// refracts, hardly any is made. A guide that has become useless is dropped; classical sampling keeps a share that
    /// bounds all weights. A few interior walks are left unguided, to compare variance times cost. Where that is
    /// clearly less for those that follow the learned field all are from then on, and if `next` is rendering unless it
    /// is clearly more.
    void learn(const std::map<int, SecondMoments::Sums>& moments, NextWalks next);
    /// The same from the interior walks themselves, all of this medium, as they were recorded.
    void learn_from(std::span<const InteriorWalkRecord> interior_walks, NextWalks next);

    /// What is learned; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& mixes) {
        const std::size_t cells = mixes.plans_.size();
        bytes(mixes.plans_, mixes.seen_, mixes.is_given_up_, mixes.brought_, mixes.expected_, mixes.connects_,
              mixes.connects_through_);
        bytes.require(mixes.plans_.size() == cells && mixes.brought_.size() == cells &&
                      (mixes.expected_.empty() || mixes.expected_.size() == cells));
        for (const TechniqueMix& plan : mixes.plans_) {
            // Each is a ray, or several.
            constexpr int most_connections = 64;
            for (const NextEventSettings& next : {plan.guided, plan.unguided}) {
                bytes.require(next.at_surfaces >= 0 && next.at_surfaces <= most_connections);
            }
        }
    }

private:
    struct Brought {
        double interior_walks = 0, light = 0;
    };
    /// Everywhere.
    Brought all_brought() const;
    /// Learns what interior walks bring.
    void expect(const std::map<int, SecondMoments::Sums>& moments);

    static constexpr int side = 6;

    Box3 box_;
    std::vector<TechniqueMix> plans_;
    NextWalks seen_ = NextWalks::beside_classical;
    bool is_given_up_ = false;
    std::vector<Brought> brought_;  // by cell, seen so far, of all kinds
    std::vector<float> expected_;   // by cell; empty before anything is learned
    bool connects_ = false;
    bool connects_through_ = false;
};

}  // namespace wend
