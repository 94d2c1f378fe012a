// Which ways to sample a stay in a dense medium pay, by the place where it begins: learned from what stays brought.
#pragma once

#include <wend/core/vector.h>
#include <wend/decision/slab_guide.h>

#include <map>
#include <vector>

namespace wend {

/// How light that is brought changes, relatively: how much less it would be for more of each technique, and how much
/// more for a larger logarithm of the preference of
/// StayPlan::Connecting.
struct StaySlope {
    SlabGuide::Shares shares{};
    float preference = 0;
};

/// What a walk found during a stay in a dense medium and after it, up to the next.
struct Stay {
    int medium = -1;  ///< none if negative
    Vec3 entry{0, 0, 0};
    bool guided = true;
    int flights = 0;
    float brought = 0;
    /// Density of each technique over that of the mixture, at the end of the stay or now.
    SlabGuide::Shares relative{};
    /// Sum of what was brought, times its slope.
    StaySlope slope{};
    /// Whether connections to lights from inside have succeeded: straight ones, and those that boundaries refract.
    bool connected = false;
    bool connected_through = false;

    void bring(float light, const StaySlope& relative_slope) {
        brought += light;
        for (std::size_t i = 0; i < slope.shares.size(); ++i) {
            slope.shares[i] += light * relative_slope.shares[i];
        }
        slope.preference += light * relative_slope.preference;
    }
    /// The stay as if it had brought that much more.
    Stay times(float factor) const {
        Stay result = *this;
        result.brought = 0;
        result.slope = {};
        result.bring(factor, slope);
        result.brought *= brought;
        return result;
    }
};

/// How stays are sampled.
struct StayPlan {
    /// Of guided stays.
    SlabGuide::Shares shares{1};
    /// Of leaving a stay unguided.
    float unguided_probability = 0;
    /// Whether that means to classical sampling alone, or as well to what the learned field says.
    bool is_unguided_classical = true;
    /// How vertices are connected to lights that the walk may run into as well.
    struct Connecting {
        /// What multiplies the density of the walk's own directions where it is weighed against that of connections. A
        /// guided stay brings nearly the same wherever it ends, to which connections would only add noise; in a thin or
        /// badly guided medium they do the work.
        float preference = 1;
        /// Of connecting a collision at all: where connections count for little they are few.
        float probability = 1;
        /// Of connecting it along a way that boundaries refract, which takes several rays to find.
        float through_boundaries = 0;
        /// Connections of a vertex on a surface that is met from inside. It took many flights to get there, so that
        /// which lamp is chosen should not add to the variance.
        int at_surfaces = 1;
    };
    Connecting guided;    ///< in guided stays
    Connecting unguided;  ///< in others
    /// Of telling the learned field what a guided stay meets on its way: the field takes over where guides are given
    /// up.
    float told_probability = 1;
};

/// Sums over stays that began in the same cell of the same medium, for the second moment of what one brings, F. With
/// the share of technique i, of density p_i in the mixture p, that changes by E[F² p_i / p + 2 F dF]: F itself falls by
/// F p_i / p, but for what is weighted against connections to lights. E[p_i / p] is 1, so the covariance with F² does
/// for the first term, which is the less noisy the less F varies.
class StayMoments {
public:
    /// `shares` are those that the stay was drawn with, if strategies are to be compared. Stays that are not finite say
    /// nothing.
    void add(int cell, const Stay& stay, const SlabGuide::Shares& shares = {});
    StayMoments& operator+=(const StayMoments& other);

    /// Of guided stays, or of others.
    struct Kind {
        std::array<double, 5> powers{};  ///< of F, from the zeroth on
        double flights = 0;

        Kind& operator+=(const Kind& other);
    };
    struct Sums {
        using PerTechnique = std::array<double, 1 + SlabGuide::most_strategies>;
        Kind guided, unguided;
        // Of guided stays:
        PerTechnique slopes{};     ///< -(F² p_i / p + 2 F dF)
        PerTechnique densities{};  ///< p_i / p
        double connected = 0;      ///< number of stays
        double connected_through = 0;
        double preference_slope = 0;  ///< of F² with the logarithm of the preference
        PerTechnique slope_squares{};
        double preference_slope_squares = 0;
        PerTechnique errors_without{};  ///< of (F - 1)² if a technique had no share

        Sums& operator+=(const Sums& other);
    };
    /// By cell, of one medium.
    const std::map<int, Sums>& of(int medium) const;

private:
    std::map<int, std::map<int, Sums>> media_;
};

/// What comes after what stays have taught.
enum class NextStays {
    beside_classical,  ///< stays to learn from; unguided ones are left to classical sampling alone
    beside_field,      ///< the same, and unguided ones follow the learned field, as they are going to
    rendering,         ///< stays that teach nothing any more
};

/// Plans in a grid of cells.
class StayPlans {
public:
    StayPlans(const Box3& box, const SlabGuide::Shares& start);

    int cell_at(const Vec3& entry) const;
    const StayPlan& plan(int cell) const { return plans_[static_cast<std::size_t>(cell)]; }
    /// The stay with what it brought over what is expected in its cell, as errors of a picture count relative to it;
    /// but no more than 30 times that: what is found by a rare chance says little of the ways to sample a stay, and its
    /// square would decide on them. What moments are to be made of.
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
    /// Of strategies that the others can do without, the first technique whose loss is the greatest gain; 0 if there is
    /// none.
    std::size_t dispensable(const StayMoments::Sums& all) const;
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
