// Whether a cell is too large: do its two halves differ? (docs/theory/learned_field.md)
#pragma once

#include <wend/guide/lobe_fit.h>

#include <array>

namespace wend::guide {

/// Where the records of a cell lie, those of zero radiance included, relative to the reference point.
struct Places {
    Vec3 mean;
    Vec3 variance;
};

/// What is lost by pretending that all of a cell sees the same.
struct SplitEvidence {
    /// The axis along which the cell varies most; -1 where nothing is known.
    int axis = -1;
    /// Divergence in nats between what is seen at a position and on average, as far as it is linear in the position.
    double gain = 0;
    /// How many standard deviations the evidence is above what chance makes of a cell without variation.
    double significance = 0;
};

/// Compares where the radiance of each lobe was seen with where records lie, and how directions turn with the position
/// with what parallax explains.
SplitEvidence split_evidence(const LobeModel& model, const std::array<LobeSums, max_lobes>& sums, const Places& places);

}  // namespace wend::guide
