// Changing the number of lobes: split where one does not fit its records, merge where one would do (ruppert2020).
#pragma once

#include <wend/guide/lobe_fit.h>

#include <array>

namespace wend::guide {

/// A model and the sums that it was fitted to.
struct LearnedLobes {
    LobeModel model;
    std::array<LobeSums, max_lobes> sums;
};

/// Merges lobes that can hardly be told apart, and splits lobes whose records spread otherwise than a lobe does, along
/// their longest axis; at most `most_lobes` remain. Every change is made to the model and to the `earlier` sums alike,
/// so that expectation maximization can go on from there. Returns whether anything was changed.
bool revise_lobes(LearnedLobes& learned, std::array<LobeSums, max_lobes>& earlier, int most_lobes);

/// χ² divergence of one lobe of the same mean direction vector from the mixture of two: ∫ (p a + q b)² / c dω - 1, with
/// p + q = 1, in closed form; infinite where it overflows.
double merging_divergence(const WeightedVmf& a, const WeightedVmf& b);

/// Nats per record that a better shape than a lobe's could gain.
struct Misfit {
    /// By spreading unequally along two axes.
    double unequal = 0;
    /// By another distribution of the distances from the mean; and whether it has a heavier tail than the lobe.
    double radial = 0;
    bool heavy_tailed = false;

    double total() const { return unequal + radial; }
};
Misfit misfit(const LobeSums& sums, const Vmf& vmf);

}  // namespace wend::guide
