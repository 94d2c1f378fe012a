// Weighted expectation maximization of one cell's lobes (docs/theory/learned_field.md).
#pragma once

#include <wend/guide/fit.h>
#include <wend/guide/lobe_lanes.h>
#include <wend/guide/mixture.h>
#include <wend/guide/statistics.h>

#include <array>
#include <span>

namespace wend::guide {

/// The unknowns of a cell: lobes as seen from its reference point, and the inverse distances of their sources.
struct LobeModel {
    VmfMixture mixture;
    Lanes inverse_distance;
};

/// Equal lobes spread over the sphere on a Fibonacci spiral, wide enough to overlap.
LobeModel initial_lobes(int lobes);

/// Sums per lobe of the observations, each divided among the lobes by the probability that it came from them.
/// Weights are multiplied by `weight_unit`.
std::array<LobeSums, max_lobes> expectation(const LobeModel& model, std::span<const Observation> observations,
                                            double weight_unit);

/// The most probable lobes given the sums. Lobes without records keep their mean. `radius` is the distance within which
/// lobes are re-aimed: sources are given a distance only when it is reliably larger.
LobeModel maximization(const std::array<LobeSums, max_lobes>& sums, const LobeModel& previous, const LobePriors& priors,
                       double radius);

}  // namespace wend::guide
