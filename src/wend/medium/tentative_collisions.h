// The tentative collisions of tracking, along a ray whose rate of them changes from cell to cell.
#pragma once

#include <wend/core/random.h>
#include <wend/sampling/warp.h>

#include <algorithm>

namespace wend {

/// A Poisson process by optical depth: the depth up to the next collision is drawn once and used up cell by cell, so
/// that cells in which nothing happens cost no random number.
class TentativeCollisions {
public:
    explicit TentativeCollisions(Pcg32& random) : random_(random), depth_(sample_optical_depth(random)) {}

    /// Moves `t` to the next one before `end`; false, and `t` stays, if there is none. `rate`, per unit of t, holds up
    /// to there, and is not negative. In double precision, since steps in a very dense cell can be below the spacing of
    /// floats.
    bool next(double& t, double end, double rate) {
        const double left = (end - t) * rate;
        if (!(depth_ < left)) {
            depth_ -= std::max(0.0, left);
            return false;
        }
        t += depth_ / rate;
        depth_ = sample_optical_depth(random_);
        return true;
    }

private:
    Pcg32& random_;
    double depth_;
};

}  // namespace wend
