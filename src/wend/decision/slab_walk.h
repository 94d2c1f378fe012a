// A walk's stay in a dense medium, with directions and distances from a mixture of classical and guided sampling.
#pragma once

#include <wend/decision/direction.h>
#include <wend/decision/distance.h>
#include <wend/decision/slab_guide.h>

#include <array>
#include <optional>

namespace wend {

/// A flight, and the probability of passing its whole segment.
struct SlabFlight {
    Flight flight;
    float pass_probability = 1;
};

/// One stay in a medium is drawn by one technique, {classical, strategies} x colour channels, and weighted by the
/// balance heuristic over the whole stay: the state holds the posterior probability of each technique given the
/// decisions so far, from which the next one is drawn. The weight never exceeds that of classical sampling over its
/// share, however long the stay (docs/theory/subsurface.md).
///
/// Enter, aim each strategy, head; then fly, and at a collision aim again, draw a direction and turn. A value: a walk
/// that splits copies it.
class SlabWalk {
public:
    bool is_inside() const { return guide_ != nullptr; }
    const SlabGuide* guide() const { return guide_; }

    /// Begins a stay; `channels` are the probabilities of the walk's colour channels. The guide is referred to.
    void enter(const SlabGuide& guide, const Rgb& channels);
    void leave() { guide_ = nullptr; }

    /// The outward normal of a strategy, from now on, and the decay along it relative to the medium's own, in [0, 1].
    void aim(int strategy, const Vec3& normal, float steepness = 1);

    /// Goes on in direction w, which no technique has drawn: at the entry, or where the boundary reflects.
    void head(const Vec3& w);

    /// Directions after a collision, given the one before. The walk is not changed, and must not change meanwhile.
    class Directions {
    public:
        Directions(const SlabWalk& walk, const Vec3& before, Pcg32& random);

        std::optional<DirectionSample> sample(float u, const Vec2& u2) const;
        float density(const Vec3& w) const;
        std::optional<Rgb> in_scattered() const { return std::nullopt; }

    private:
        const SlabWalk& walk_;
        Vec3 before_;
        Pcg32& random_;
        std::array<float, 3 * (1 + SlabGuide::most_strategies)> relative_;  // posterior over S(before)
    };

    /// The walk after it went from `before` into w at a collision.
    void turn(const Vec3& before, const Vec3& w);
    /// Whether the direction now is one that turn() chose.
    bool has_turned() const { return has_turned_; }

    /// The next flight; u in [0,1).
    SlabFlight fly(float length, float u);
    /// The probability of flying through a segment; the walk goes on behind it.
    float pass(float length);

    /// The probability that the walk goes on, given the throughput with which a walk of the scene's own roulette would
    /// be judged. Walks end where the light that the strategies expect is no longer worth their weight, but never
    /// sooner than classical ones.
    float survival(float throughput);

    /// By technique: probability under it over that under the mixture, of all decisions of the stay.
    float relative_density(int technique) const;

private:
    static constexpr int most = 3 * (1 + SlabGuide::most_strategies);
    using Values = std::array<float, most>;

    int techniques() const { return guide_->channels() * (1 + guide_->strategies); }
    const SlabMode& mode(int strategy, int channel) const {
        return guide_->mode(channel, level_[static_cast<std::size_t>(strategy)]);
    }
    /// Calls f(index, strategy, channel) for all guided techniques.
    template <class F>
    void for_guided(F&& f) const {
        std::size_t i = static_cast<std::size_t>(guide_->channels());
        for (int s = 0; s < guide_->strategies; ++s) {
            for (int c = 0; c < guide_->channels(); ++c, ++i) {
                f(i, s, c);
            }
        }
    }
    /// Draws a technique; u becomes a fresh uniform number.
    std::size_t choose(float& u) const;
    void normalize(float total);

    const SlabGuide* guide_ = nullptr;
    Values posterior_;  // strategy by strategy, the classical one first; channels within
    Values rate_;       // of the exponential flight under each technique
    std::array<Vec3, SlabGuide::most_strategies> normal_;
    std::array<int, SlabGuide::most_strategies> level_;
    float survived_ = 1;  // product of the probabilities of survival
    bool has_turned_ = false;
};

}  // namespace wend
