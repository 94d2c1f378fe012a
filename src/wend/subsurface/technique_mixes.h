// Which ways to sample an interior walk in a dense medium pay, by the place where it begins: learned from what interior
// walks brought.
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/subsurface/interior_walk.h>

#include <array>
#include <cstddef>
#include <map>
#include <span>
#include <vector>

namespace wend {

/// How vertices are connected to lights that the walk may run into as well.
struct NextEventSettings {
    /// What multiplies the density of the walk's own directions where it is weighed against that of connections. A
    /// guided interior walk brings nearly the same wherever it ends, to which connections would only add noise; in
    /// a thin or badly guided medium they do the work.
    float preference = 1;
    /// Of connecting a collision at all: where connections count for little they are few.
    float probability = 1;
    /// Of connecting it along a way that boundaries refract, which takes several rays to find.
    float through_boundaries = 0;
    /// Connections of a vertex on a surface that is met from inside. It took many flights to get there, so that
    /// which lamp is chosen should not add to the variance.
    int at_surfaces = 1;
};

/// How interior walks are sampled.
struct TechniqueMix {
    /// Probability of classical sampling in guided interior walks.
    float defensive_fraction = 1;
    /// Of leaving an interior walk unguided.
    float unguided_probability = 0;
    /// Whether that means to classical sampling alone, or as well to what the learned field says.
    bool is_unguided_classical = true;
    NextEventSettings guided;    ///< in guided interior walks
    NextEventSettings unguided;  ///< in others
    /// Of recording for the learned field what a guided interior walk meets on its way: the field takes over where
    /// guides are given up.
    float recording_probability = 1;

    /// See ListsMembers: it has padding.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& mix) {
        bytes(mix.defensive_fraction, mix.unguided_probability, mix.is_unguided_classical, mix.guided, mix.unguided,
              mix.recording_probability);
    }
};

/// What comes after what interior walks have taught.
enum class NextWalks {
    beside_classical,  ///< interior walks to learn from; unguided ones are left to classical sampling alone
    beside_field,      ///< the same, and unguided ones follow the learned field, as they are going to
    rendering,         ///< interior walks that teach nothing any more
};

/// How light that is brought changes, relatively: how much less it would be for more of each technique, and how much
/// more for a larger logarithm of the preference of NextEventSettings.
struct MixGradient {
    InteriorGuide::PerTechnique shares{};  ///< for more of each technique
    float preference = 0;                  ///< for a larger logarithm of the preference
};

/// Of light that a connection from a collision found: `here` are InteriorWalk::relative_densities() at the collision,
/// `towards` those of a walk that went the same way, to the boundary. Connections have the part `by_connections` of the
/// density that both ways are weighed by.
WEND_API MixGradient gradient_of_connection(const InteriorGuide::PerTechnique& here,
                                            const InteriorGuide::PerTechnique& towards, float by_connections);
/// Of light that the walk ran into, behind a collision with the relative densities `before`, and with these `now`:
/// connections that were weighed against it change less than the walk's density. `by_connections` is 0 where none
/// could have found it.
WEND_API MixGradient gradient_of_hit(const InteriorGuide::PerTechnique& before, const InteriorGuide::PerTechnique& now,
                                     float by_connections);

/// What a walk found during an interior walk in a dense medium and after it, up to the next.
struct InteriorWalkRecord {
    int medium = -1;      ///< none if negative
    Vec3 entry{0, 0, 0};  ///< where it began
    bool guided = true;   ///< whether by the guide; else TechniqueMix::unguided says how it was connected
    int flights = 0;      ///< as many as were drawn
    float brought = 0;    ///< the mean of the channels, over the throughput with which it began
    /// Density of each technique over that of the mixture, at the end of the interior walk or now.
    InteriorGuide::PerTechnique relative{};
    /// Sum of what was brought, times its slope.
    MixGradient slope{};
    /// Whether connections to lights from inside have succeeded: straight ones, and those that boundaries refract.
    bool connected = false;
    bool connected_through = false;  ///< the second

    /// Light was found: its mean over the channels, and how that changes with the mix.
    void bring(float light, const MixGradient& relative_slope) {
        brought += light;
        for (std::size_t i = 0; i < slope.shares.size(); ++i) {
            slope.shares[i] += light * relative_slope.shares[i];
        }
        slope.preference += light * relative_slope.preference;
    }
    /// The interior walk as if it had brought that much more.
    InteriorWalkRecord times(float factor) const {
        InteriorWalkRecord result = *this;
        result.brought = 0;
        result.slope = {};
        result.bring(factor, slope);
        result.brought *= brought;
        return result;
    }
};

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
