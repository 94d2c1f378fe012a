// How much of classical sampling a cell should keep: the share with the least second moment, as measured.
#pragma once

#include <wend/guide/path_records.h>
#include <wend/guide/region.h>

#include <array>
#include <cstddef>

namespace wend::guide {

/// Sums that compare the shares that classical sampling could have in its mixture with the guide. A direction drawn
/// with density p, of which classical sampling had the density c and the guide g, tells for every share α
///     Q_α = (f L)² / (p p_α),      p_α = α c + (1 - α) g,
/// an unbiased estimate of the second moment ∫ (f L)² / p_α dω of what a draw with that share is worth
/// (docs/theory/learned_field.md).
struct ShareSums {
    static constexpr std::array<double, 5> shares = {0.1, 0.3, 0.5, 0.7, 0.9};
    static constexpr std::size_t half = 2;
    /// The share where nothing is known.
    static constexpr double unproven = shares[1];
    static_assert(static_cast<float>(unproven) == unproven_defensive_fraction);

    /// Of Q_α for each of the shares.
    std::array<double, shares.size()> moment{};
    /// Of the square of Q for equal shares.
    double square = 0;

    /// Adds a usable record; one that does not know both densities says nothing.
    void add(const Record& record);

    /// The share with the least second moment, 0.1 to 0.9. It stays near `unproven` until many records speak
    /// against it, and one bright record counts as one.
    float best() const;

    /// All sums times `linear`, the square times `quadratic`.
    ShareSums scaled(double linear, double quadratic) const;
};

}  // namespace wend::guide
