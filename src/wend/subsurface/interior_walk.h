// A walk's interior walk in a dense medium, with directions and distances from a mixture of classical and guided
// sampling.
#pragma once

#include <wend/decision/direction.h>
#include <wend/decision/distance.h>
#include <wend/subsurface/emitter_guide.h>
#include <wend/subsurface/interior_guide.h>

#include <array>
#include <optional>

namespace wend {

/// A flight, and the probability of passing its whole segment.
struct InteriorFlight {
    Flight flight;
    float pass_probability = 1;
};

/// One interior walk in a medium is drawn by one technique, {classical, strategies} x colour channels, and weighted by
/// the balance heuristic over the whole interior walk: the state holds the posterior probability of each technique
/// given the decisions so far, from which the next one is drawn. The weight never exceeds that of classical sampling
/// over its share, however long the interior walk (docs/theory/subsurface.md).
///
/// Enter, aim each strategy, head; then fly, and at a collision aim again, draw a direction and turn. A value: a walk
/// that splits copies it.
class InteriorWalk {
public:
    bool is_inside() const { return is_inside_; }
    /// Of the interior walk; null outside.
    const InteriorGuide* guide() const { return is_inside_ ? guide_ : nullptr; }

    /// Begins an interior walk; `channels` are the probabilities of the walk's colour channels. The guide is referred
    /// to. Strategies without a share cost nothing: slots hold the others, in their order.
    void enter(const InteriorGuide& guide, const Rgb& channels, const InteriorGuide::Shares& shares);
    void enter(const InteriorGuide& guide, const Rgb& channels) { enter(guide, channels, guide.share); }
    void leave() { is_inside_ = false; }

    int slots() const { return slots_; }
    /// The strategy in a slot.
    int strategy(int slot) const { return strategy_[static_cast<std::size_t>(slot)]; }
    /// The outward normal of a slot's strategy, from now on, and the decay along it relative to the medium's own, in
    /// [0, 1].
    void aim(int slot, const Vec3& normal, float steepness = 1);
    /// Whether a slot's strategy heads for lamps, and what it sees of them from now on.
    bool is_lit(int slot) const { return slot == lit_; }
    void aim(const EmitterView& view);

    /// Goes on in direction w, which no technique has drawn: at the entry, or where the boundary reflects.
    void head(const Vec3& w);

    /// Directions after a collision, given the one before. The walk is not changed, and must not change meanwhile.
    class Directions {
    public:
        Directions(const InteriorWalk& walk, const Vec3& before, Pcg32& random);

        std::optional<DirectionSample> sample(float u, const Vec2& u2) const;
        float density(const Vec3& w) const;
        std::optional<Rgb> in_scattered() const { return std::nullopt; }

        /// A direction out to a lamp, for a connection to it at the boundary: the more often the more of the light that
        /// is scattered here comes straight from lamps.
        std::optional<Vec3> sample_emitters() const;
        /// Its density, times the probability that there is one.
        float emitter_density(const Vec3& w) const;

    private:
        friend class InteriorWalk;

        const InteriorWalk& walk_;
        Vec3 before_;
        Pcg32& random_;
        std::array<float, 3 * (1 + InteriorGuide::most_strategies)> relative_;  // posterior over S(before)
        EmitterGuide::PerEmitter lamps_{};                                      // posterior of directions in each lobe
        std::array<EmitterGuide::PerEmitter, 3> shares_{};  // by channel, of each lamp in the strategy
        EmitterGuide::PerEmitter connected_{};              // probability of a connection to each lamp
    };

    /// Goes on in direction w from a collision, of which `directions` were made when the walk was as it is.
    void turn(const Directions& directions, const Vec3& w);
    /// Whether the direction now is one that turn() chose.
    bool has_turned() const { return has_turned_; }

    /// How far the next flight would go if nothing were in its way; u in [0,1). No further need a ray be traced.
    float draw_distance(float u) const;
    /// That flight where the medium goes on for `length`, of which it matters only whether it is more than `drawn`.
    InteriorFlight fly(float length, float drawn);
    /// The probability of flying through a segment; the walk goes on behind it.
    float pass(float length);

    /// The probability that the walk goes on, given the throughput with which a walk of the scene's own roulette would
    /// be judged. Walks end where the light that the strategies expect is no longer worth their weight, but never
    /// sooner than classical ones.
    float survival(float throughput);

    /// Of classical sampling and each strategy: its probability of all decisions of the interior walk, or of the last
    /// one, over that of the mixture; 0 without a share.
    InteriorGuide::Shares relative_densities() const;
    /// The probability with which this interior walk was to be a classical one.
    float defensive_fraction() const { return share_[0]; }

private:
    static constexpr int most = 3 * (1 + InteriorGuide::most_strategies);
    using Values = std::array<float, most>;

    int techniques() const { return guide_->channels() * (1 + slots_); }
    const HalfSpaceMode& mode(int slot, int channel) const {
        return guide_->mode(channel, level_[static_cast<std::size_t>(slot)]);
    }
    float relative_density(int group) const;
    /// Calls f(index, slot, channel) for all techniques that follow a mode.
    template <class F>
    void for_modes(F&& f) const {
        std::size_t i = static_cast<std::size_t>(guide_->channels());
        for (int s = 0; s < slots_; ++s) {
            for (int c = 0; c < guide_->channels(); ++c, ++i) {
                f(i, s, c);
            }
        }
    }
    /// The strategy that heads for lamps expects the light of its mode beside theirs: this times the mode's.
    float diffuse(int channel) const { return lamps_.diffuse()[channel] / mode(lit_, channel).inward_radiance(); }
    /// What a collision scatters to a walk that arrived along `before`, times the mode's: of both, given the phase
    /// function for each lamp.
    float scattered(int channel, const EmitterGuide::PerEmitter& phases, const Vec3& before) const;
    /// Draws a technique; u becomes a fresh uniform number.
    std::size_t choose(float& u) const;
    void normalize(float total);
    /// head(), given the densities of the lamps' lobes.
    void head(const Vec3& w, const EmitterGuide::PerEmitter& densities);
    /// Counts a flight in; returns its probability under the mixture, or density if it `collides` there.
    float weigh_flight(float length, bool collides);

    const InteriorGuide* guide_ = nullptr;
    bool is_inside_ = false;
    int slots_ = 0;
    std::array<int, InteriorGuide::most_strategies> strategy_;
    InteriorGuide::Shares share_;  // of classical sampling, then slot by slot
    Values posterior_;             // slot by slot, classical sampling first; channels within
    Values rate_{};                // of the exponential flight under each technique that has one
    int lit_ = -1;                 // slot of the strategy that heads for lamps; none if negative
    EmitterGuide lamps_;
    std::array<float, 3> direct_{};  // by channel, the part of the light ahead that comes straight from lamps
    std::array<Vec3, InteriorGuide::most_strategies> normal_;
    std::array<int, InteriorGuide::most_strategies> level_;
    float survived_ = 1;  // product of the probabilities of survival
    bool has_turned_ = false;
};

}  // namespace wend
