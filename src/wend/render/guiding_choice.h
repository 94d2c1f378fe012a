// Whether guiding pays: which kind of walk each tile of the picture gets, by what walks of each kind have shown there.
#pragma once

#include <wend/render/preset.h>
#include <wend/render/walk_tally.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace wend {

/// Walks that are guided in the same way.
struct WalkKind {
    Preset preset;
    bool guides_dense_media = false;  ///< by the guides of the render's SubsurfacePreset

    bool is_classical() const { return preset.is_classical() && !guides_dense_media; }
    friend bool operator==(const WalkKind&, const WalkKind&) = default;
};
/// What a segment of a guided interior walk costs beyond others.
inline constexpr double cost_of_interior_segment = 0.7;
/// Of the walks of a tile, those of each kind; they add up to 1.
using WalkShares = std::array<float, most_walk_kinds>;

/// What of a scene can be guided besides directions and survival.
struct Guidable {
    bool flights = false;      ///< there is a medium where free flights can be
    bool dense_media = false;  ///< and one where interior walks can be
};

/// Chooses among kinds of walks, tile by tile. What counts is squared error times work, both of earlier passes, so that
/// no walk has a say in its own weight. All begin with walks that follow nothing learned: classical ones, but for the
/// guides of dense media, which know what they do from the start. Then a few of every kind are tried. Where that leaves
/// it open whether guiding pays, as many of each kind follow; else those that take directions from the fields. The best
/// of a tile goes on, and others as long as they are close. A picture that is too small for a trial has one kind,
/// guided in all ways.
class GuidingChoice {
public:
    /// By fewer pixels a trial of a few samples tells nothing.
    static constexpr double fewest_pixels = 1000;

    /// Of the kinds that a preset allows: several where it guides where that pays, of which the first follows nothing
    /// learned.
    /// `is_taught`: whether there is a field from the start. `pixels`: of the picture.
    GuidingChoice(const Preset& preset, const Guidable& guidable, bool is_taught, std::size_t tiles, double pixels);

    std::span<const WalkKind> kinds() const { return kinds_; }
    /// In a pass of so many samples of each pixel.
    WalkShares shares(std::size_t tile, int samples) const;
    /// The kind of one of the samples that a pixel has in a pass, by the shares of its tile: those of a kind follow
    /// each other, as low-discrepancy sequences want it.
    static std::size_t kind_of(const WalkShares& shares, std::uint64_t seed, std::uint64_t pixel, int sample,
                               int samples);

    /// Of a segment, in those of classical walks; those of guided interior walks cost more.
    static double cost_of_segment(const WalkKind& kind);

    /// Chooses anew, by what the walks of a pass have shown in each tile, after so many samples of each pixel; whether
    /// that changes anything. `learns`: whether the pass has taught the fields, so that guided walks will be others.
    bool learn(std::span<const WalkTallies> pass, int samples, bool learns);

    /// Whether any walk may be guided in a pass of so many samples of each pixel.
    bool guides(int samples) const;
    /// Whether it is known where guiding pays.
    bool has_chosen() const { return state_ == State::chosen; }
    /// Whether kinds are being tried.
    bool is_trial() const { return state_ == State::trial; }
    /// Whether guiding brings so much that to teach the fields further pays.
    bool guiding_pays() const { return gain_ > 2; }
    /// Of the walks of a pass of so many samples that take no directions from the fields, those that are worth
    /// recording: the more, the more guiding has been found to bring.
    double recorded_share(int samples) const;
    /// Of the walks of a pass of so many samples, those that take directions from the fields.
    double directed_share(int samples) const;

    /// Of a walk of each kind in the whole picture, were all walks of that kind: its variance relative to the picture's
    /// mean, and its work; estimates, 0 where none was tried.
    struct Means {
        double square = 0, work = 0;
    };
    std::array<Means, most_walk_kinds> means() const;

    /// What has been shown and chosen, for the same kinds and tiles; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& choice) {
        const std::size_t tiles = choice.tallies_.size();
        bytes(choice.shares_, choice.tallies_, choice.state_, choice.gain_);
        bytes.require(choice.shares_.size() == tiles && choice.tallies_.size() == tiles &&
                      choice.state_ >= State::plain && choice.state_ <= State::chosen);
    }

private:
    void remember(std::span<const WalkTallies> pass, bool learns);
    /// Of the first walks of other kinds, the share of each in a pass of so many samples of each pixel; 0 where they
    /// would be too few.
    float probed_share(int samples) const;
    /// From now on there are as many walks of each kind, or of each that takes directions from the fields.
    void begin_trial(bool of_all);
    /// Whether each kind that takes directions from the fields has walks in a pass.
    bool shows_directed(std::span<const WalkTallies> pass) const;
    TallyProducts products(double WalkTally::*what) const { return TallyProducts(tallies_, kinds_.size(), what); }
    /// What walks of the first kind would show, as those of every kind tell it: tiles, times its first number.
    TallyProducts unguided_squares() const;
    /// Of squared errors, with those of light that a kind has not found yet.
    TallyProducts squared_errors(const TallyProducts& unguided) const;
    /// Of walks of the first kind, in a tile.
    double unguided_square(std::size_t tile, const TallyProducts& unguided) const;
    WalkShares chosen_for(std::size_t tile, const TallyProducts& unguided, const TallyProducts& squares,
                          const TallyProducts& work, bool learns) const;

    double pixels_;
    std::vector<WalkKind> kinds_;
    std::vector<WalkShares> shares_;
    std::vector<WalkTallies> tallies_;
    enum class State { plain, probe, trial, chosen } state_ = State::plain;
    double gain_ = 0;  ///< of what is learned, in the whole picture
};

}  // namespace wend
