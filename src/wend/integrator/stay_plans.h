// Which ways to sample a stay in a dense medium pay, by the place where it begins: learned from what stays brought.
#pragma once

#include <wend/core/vector.h>
#include <wend/integrator/stay.h>
#include <wend/integrator/stay_moments.h>
#include <wend/integrator/stay_plan.h>

#include <cstddef>
#include <map>
#include <vector>

namespace wend {

/// Plans in a grid of cells.
class StayPlans {
public:
    StayPlans(const Box3& box, const SlabGuide::Shares& start);

    int cell_at(const Vec3& entry) const;
    const StayPlan& plan(int cell) const { return plans_[static_cast<std::size_t>(cell)]; }
    /// The stay with what it brought over what is expected in its cell, as errors of a picture count relative to it,
    /// but no more than StayMoments::most_expected. What moments are to be made of.
    Stay relative(const Stay& stay) const;

    /// `moments` by cell, of relative() stays. Moves the logarithms of each share, and of the preference, down the
    /// slope of the second moment relative to the variance of F, as far as the slope is significant. Cells that few
    /// stays began in follow all others. Where no connection has ever succeeded, behind a boundary that refracts,
    /// hardly any is made. A strategy that has become useless is dropped, and so is one without which variance times
    /// cost is clearly less, as others do the same; classical sampling keeps a share that bounds all weights. A few
    /// stays are left unguided, to compare variance times cost. Where that is clearly less for those that follow the
    /// learned field all are from then on, and if `next` is rendering unless it is clearly more.
    void learn(const std::map<int, StayMoments::Sums>& moments, NextStays next);

private:
    struct Brought {
        double stays = 0, light = 0;
    };
    /// Everywhere.
    Brought all_brought() const;
    /// Techniques beside classical sampling that have a share anywhere.
    std::vector<std::size_t> strategies() const;
    /// Learns what stays bring.
    void expect(const std::map<int, StayMoments::Sums>& moments);

    static constexpr int side = 6;

    Box3 box_;
    std::vector<StayPlan> plans_;
    NextStays seen_ = NextStays::beside_classical;
    bool is_given_up_ = false;
    std::vector<Brought> brought_;  // by cell, seen so far, of all kinds
    std::vector<float> expected_;   // by cell; empty before the first lesson
    bool connects_ = false;
    bool connects_through_ = false;
};

}  // namespace wend
