// A walk's interior walk in a dense medium, with directions and distances from a mixture of classical and guided
// sampling.
#pragma once

#include <wend/core/export.h>
#include <wend/core/random.h>
#include <wend/decision/direction.h>
#include <wend/decision/flight.h>
#include <wend/subsurface/emitter_guide.h>
#include <wend/subsurface/interior_guide.h>

#include <array>
#include <cstddef>
#include <optional>

namespace wend {

/// How far a walk got, and how likely it was to get through.
struct InteriorFlight {
    Flight flight;               ///< its weight is complete
    float pass_probability = 1;  ///< under the mixture, of passing the segment; 1 if it scatters
};

/// One interior walk in a medium is drawn by one technique, {classical, guided} x colour channels, and weighted by the
/// balance heuristic over the whole interior walk: the state holds the posterior probability of each technique given
/// the decisions so far, from which the next one is drawn. The weight never exceeds that of classical sampling over its
/// share, however long the interior walk (docs/theory/subsurface.md).
///
/// Enter, aim, head; then fly, and at a collision aim again, draw a direction and turn. A value: a walk that splits
/// copies it.
class WEND_API InteriorWalk {
public:
    /// Null before enter().
    const InteriorGuide* guide() const { return guide_; }

    /// Begins an interior walk; `channels` are the probabilities of the walk's colour channels, `defensive_fraction`
    /// that of classical sampling. The guide is referred to.
    void enter(const InteriorGuide& guide, const Rgb& channels, float defensive_fraction);
    /// The same with the guide's own share of classical sampling.
    void enter(const InteriorGuide& guide, const Rgb& channels) { enter(guide, channels, guide.defensive_fraction); }

    /// Whether anything but classical sampling may draw this interior walk: otherwise it need not be aimed.
    bool is_guided() const { return groups_ > 1; }
    /// From now on the boundary has this outward normal, and light decays by `steepness`, in [0, 1], relative to the
    /// medium's own decay.
    void aim(const Vec3& normal, float steepness = 1);
    /// Whether the guide heads for lamps: then it is to be given what it sees of them.
    bool heads_for_emitters() const { return is_lit_; }
    /// What the walk sees of lamps from now on; their span is referred to.
    void aim(const EmitterView& view);

    /// Goes on in direction w, which no technique has drawn: at the entry, or where the boundary reflects.
    void head(const Vec3& w);

    /// Directions after a collision, given the one before. The walk is not changed, and must not change meanwhile.
    class Directions {
    public:
        /// At a collision, for a walk that arrived along `before`. Refers to the walk and to the generator.
        Directions(const InteriorWalk& walk, const Vec3& before, Pcg32& random);

        /// A direction, from a number of [0,1), which chooses the technique, and a point of [0,1)². A direction along a
        /// mode takes further numbers from the generator.
        std::optional<DirectionSample> sample(float u, const Vec2& u2) const;
        /// Of any direction under the mixture, in 1/sr.
        float density(const Vec3& w) const;
        /// Nothing: survival() judges walks instead.
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
        std::array<float, 6> relative_;                     // posterior over S(before)
        EmitterGuide::PerEmitter lamps_{};                  // posterior of directions in each lobe
        std::array<EmitterGuide::PerEmitter, 3> shares_{};  // by channel, of each lamp in guided sampling
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
    /// be judged. Walks end where the light that the guide expects is no longer worth their weight, but never sooner
    /// than classical ones.
    float survival(float throughput);

    /// Of each technique: its probability of all decisions of the interior walk, or of the last one, over that of the
    /// mixture; 0 without a share.
    InteriorGuide::PerTechnique relative_densities() const;

private:
    using Values = std::array<float, 6>;

    int channels() const { return guide_->channels(); }
    std::size_t techniques() const { return static_cast<std::size_t>(channels() * groups_); }
    /// Of a channel, guided.
    std::size_t guided(int channel) const { return static_cast<std::size_t>(channels() + channel); }
    const HalfSpaceMode& mode(int channel) const { return guide_->mode(channel, level_); }
    float relative_density(int group) const;
    /// Calls f(index, channel) for all techniques that follow a mode.
    template <class F>
    void for_modes(F&& f) const {
        for (int c = 0; groups_ > 1 && c < channels(); ++c) {
            f(guided(c), c);
        }
    }
    /// A guide that heads for lamps expects the light of its mode beside theirs: this times the mode's.
    float diffuse(int channel) const { return lamps_.diffuse()[channel] / mode(channel).inward_radiance(); }
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
    bool is_lit_ = false;
    bool has_turned_ = false;
    int groups_ = 1;    // 2: classical and guided
    float share_[2]{};  // of classical and of guided sampling
    Values posterior_;  // classical sampling first; channels within
    Values rate_{};     // of the exponential flight under each technique
    EmitterGuide lamps_;
    std::array<float, 3> direct_{};  // by channel, the part of the light ahead that comes straight from lamps
    Vec3 normal_;
    int level_ = 0;
    float survived_ = 1;  // product of the probabilities of survival
};

}  // namespace wend
