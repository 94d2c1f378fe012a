// A walk's interior walk in a dense medium, with directions and distances from a mixture of classical and guided
// sampling.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/export.h>
#include <wend/core/random.h>
#include <wend/decision/direction.h>
#include <wend/decision/distance.h>
#include <wend/medium/homogeneous.h>
#include <wend/medium/phase.h>
#include <wend/sampling/vmf.h>
#include <wend/subsurface/half_space_mode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

namespace wend {

/// How to guide a walk in a dense homogeneous medium: along a mode of the tangent half-space whose outward normal the
/// walk is told, mixed with classical sampling.
struct InteriorGuide {
    /// One number each for classical and for guided sampling.
    using PerTechnique = std::array<float, 2>;

    /// What walks go through.
    HomogeneousMedium medium;
    /// Modes that decay ever faster, the first not at all and the last as the medium's own; for one channel where all
    /// channels are alike, or for three.
    std::vector<std::vector<HalfSpaceMode>> modes;
    /// Probability of classical sampling where no other is given, in (0, 1]; 1: walks are not guided.
    float defensive_fraction = 1;
    /// Whether walks head for lamps outside as well as along their mode.
    bool heads_for_emitters = false;
    /// Whether walks can be connected to lamps where they meet the boundary, as they can if it is rough.
    bool connects_at_boundary = false;

    /// Colour channels that are distinguished: 1 or 3.
    int channels() const { return static_cast<int>(modes.size()); }
    /// The mode of a channel for a decay of `steepness`, in [0, 1], times that of the last.
    int level(float steepness) const {
        const auto last = static_cast<float>(modes[0].size() - 1);
        return static_cast<int>(std::lround(std::clamp(steepness, 0.0f, 1.0f) * last));
    }
    /// A mode by its channel and its level().
    const HalfSpaceMode& mode(int channel, int level) const {
        return modes[static_cast<std::size_t>(channel)][static_cast<std::size_t>(level)];
    }
};

/// `share_of_a` of the first, the rest of the second.
inline InteriorGuide::PerTechnique mix(const InteriorGuide::PerTechnique& a, const InteriorGuide::PerTechnique& b,
                                       float share_of_a) {
    InteriorGuide::PerTechnique result;
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i] = share_of_a * a[i] + (1 - share_of_a) * b[i];
    }
    return result;
}

/// A guide with this probability of classical sampling, in (0, 1]; `modes` are those of the medium
/// (subsurface/half_space_mode.h has them). Throws InputError for numbers out of range, and for modes that are not as
/// InteriorGuide has them.
WEND_API InteriorGuide interior_guide(const HomogeneousMedium& medium, std::vector<std::vector<HalfSpaceMode>> modes,
                                      float defensive_fraction = 0.25f);

/// A lamp outside as it is seen just inside of a boundary.
struct BoundaryEmitter {
    Vmf lobe;           ///< of the directions in which a walk flies out to it
    float cosine = 1;   ///< of the lobe's mean to the outward normal, in (0, 1]
    float fluence = 0;  ///< radiance over all directions
    float peak = 0;     ///< vmf_peak() of the lobe
};

/// What a walk inside a medium may expect of the light outside, where it is.
struct EmitterView {
    std::span<const BoundaryEmitter> lamps;  ///< at the closest boundary; referred to; EmitterGuide::most at most
    float depth = 0;                         ///< below it, in scene units
    Rgb diffuse{1.0f};                       ///< radiance that a walk may expect that turns away from it
};

/// The part of the light that has not been scattered yet: that of each lamp falls off as exp(-extinction depth /
/// cosine), and is seen within its lobe.
class WEND_API EmitterGuide {
public:
    /// Most lamps; those beyond are left out.
    static constexpr std::size_t most = 4;
    /// One number a lamp, 0 for those that are not there.
    using PerEmitter = std::array<float, most>;

    /// Of no lamp.
    EmitterGuide() = default;
    /// What a view becomes in a medium of this extinction, of which the first `channels` channels, 1 or 3, are asked
    /// for. Refers to the view's lamps.
    EmitterGuide(const EmitterView& view, const Rgb& extinction, int channels);

    /// EmitterView::diffuse, at least 1e-20, so that walks always have somewhere to go.
    const Rgb& diffuse() const { return diffuse_; }
    /// How many lamps there are.
    std::size_t size() const { return size_; }
    /// Directions in which a walk flies out to a lamp.
    const Vmf& lobe(std::size_t lamp) const { return lamps_[lamp].lobe; }

    /// The densities of the lobes in a direction.
    PerEmitter densities(const Vec3& w) const;
    /// The phase function for each lamp, of a walk that arrives along `before`.
    PerEmitter phases(const PhaseFunction& phase, const Vec3& before) const;
    /// The fluence of a lamp where the walk is.
    float fluence(int channel, std::size_t lamp) const { return arriving_[static_cast<std::size_t>(channel)][lamp]; }

private:
    const BoundaryEmitter* lamps_ = nullptr;
    std::size_t size_ = 0;
    std::array<PerEmitter, 3> arriving_{};  // by channel, fluence of each lamp
    Rgb diffuse_;
};

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
