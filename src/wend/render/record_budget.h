// How many walks of a pass are recorded.
#pragma once

#include <algorithm>

namespace wend {

/// Keeps what one pass tells the fields within bounds, however large the picture is: of more walks, fewer are recorded.
/// Memory and the time to train would grow with the picture otherwise, and many more records than there are cells to
/// teach say little that is new (docs/experiments/learned_field.md).
class RecordBudget {
public:
    /// About so many records a pass; positive.
    explicit RecordBudget(double most) : most_(most) {}

    /// Of so many walks, the share to be recorded, in (0,1].
    double share(double walks) const { return std::min(1.0, most_ / (walks * per_walk_)); }

    /// So many walks were recorded, as a mean, and left so many records.
    void learn(double walks, double records) {
        if (walks > 0 && records > 0) {
            per_walk_ = records / walks;
        }
    }

private:
    double most_;
    /// More than most walks tell: a first pass that is recorded too little costs less than one too much.
    double per_walk_ = 16;
};

}  // namespace wend
