// The lobes of one cell, and how many of them, from what is observed there (docs/theory/learned_field.md).
#pragma once

#include <wend/guide/fit.h>
#include <wend/guide/lobe_revision.h>
#include <wend/guide/region.h>

#include <array>
#include <span>

namespace wend::guide {

/// Stepwise expectation maximization: the sums of earlier fits stay, those of the observations are found anew in each
/// round.
class LobeLearning {
public:
    /// Refers to the settings. A weight of 1 of the observations counts `unit`; `radius` is the distance within which
    /// lobes are re-aimed.
    LobeLearning(const FitSettings& settings, double unit, double radius)
        : settings_(settings), unit_(unit), radius_(radius) {}

    /// Lobes and their number; the earlier sums follow the number.
    LearnedLobes learn(const LobeModel& start, std::array<LobeSums, max_lobes>& earlier,
                       std::span<const Observation> observations) const;

    /// The same in less time where there are many: most rounds, which only have to find the neighbourhood, see a sample
    /// of the observations, large enough for their unequal weights (kish1965); the last one sees all.
    LearnedLobes learn_by_sample(const LobeModel& start, std::array<LobeSums, max_lobes> earlier,
                                 std::span<const Observation> observations) const;

private:
    /// The mean weight of observations is 1; in a sample they stand for more.
    LobeLearning with_unit(double unit) const { return {settings_, unit, radius_}; }
    LearnedLobes improve(const LobeModel& model, const std::array<LobeSums, max_lobes>& earlier,
                         std::span<const Observation> observations, int rounds) const;

    const FitSettings& settings_;
    double unit_, radius_;
};

/// The mean colours of what the lobes were fitted to.
LobeColours colours_of(const LearnedLobes& learned);

}  // namespace wend::guide
