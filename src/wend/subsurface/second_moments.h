// What interior walks in dense media tell of the ways to sample them: sums, counted apart by each thread.
#pragma once

#include <wend/core/export.h>
#include <wend/subsurface/interior_walk_record.h>

#include <array>
#include <map>

namespace wend {

/// Sums over interior walks that began in the same cell of the same medium, for the second moment of what one brings,
/// F. With the share of technique i, of density p_i in the mixture p, that changes by E[F² p_i / p + 2 F dF]: F itself
/// falls by F p_i / p, but for what is weighted against connections to lights. E[p_i / p] is 1, so the covariance with
/// F² does for the first term, which is the less noisy the less F varies.
class WEND_API SecondMoments {
public:
    /// What an interior walk may count for, over what is expected: what is found by a rare chance says little of the
    /// ways to sample an interior walk, and its square would decide on them.
    static constexpr float most_expected = 30;

    /// Interior walks that are not finite say nothing.
    void add(int cell, const InteriorWalkRecord& interior_walk);
    /// Counts in what another thread has counted.
    SecondMoments& operator+=(const SecondMoments& other);

    /// Of guided interior walks, or of others.
    struct Kind {
        std::array<double, 5> powers{};  ///< of F, from the zeroth on
        double flights = 0;              ///< of all of them

        /// Adds another's.
        Kind& operator+=(const Kind& other);
    };
    /// Of the interior walks of a cell.
    struct Sums {
        /// One number for each technique.
        using PerTechnique = std::array<double, std::tuple_size_v<InteriorGuide::PerTechnique>>;
        Kind guided;    ///< walks that were drawn by the guide
        Kind unguided;  ///< others
        // Of guided interior walks:
        PerTechnique slopes{};                ///< -(F² p_i / p + 2 F dF)
        PerTechnique densities{};             ///< p_i / p
        double connected = 0;                 ///< number of interior walks that connections found light in
        double connected_through = 0;         ///< the same, through boundaries
        double preference_slope = 0;          ///< of F² with the logarithm of the preference
        PerTechnique slope_squares{};         ///< sums of squares of `slopes`
        double preference_slope_squares = 0;  ///< and of `preference_slope`

        /// Adds another's.
        Sums& operator+=(const Sums& other);
    };
    /// By cell, of one medium.
    const std::map<int, Sums>& of(int medium) const;

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& moments) {
        bytes(moments.media_);
    }

private:
    std::map<int, std::map<int, Sums>> media_;
};

}  // namespace wend
