// What the learned field knows about one cell of space.
#pragma once

#include <wend/adjoint/adjoint.h>
#include <wend/core/colour.h>
#include <wend/core/vector.h>
#include <wend/guide/mixture.h>
#include <wend/medium/phase.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numeric>

namespace wend::guide {

/// A float in 16 bits: the range of a float and 8 significant bits, so a relative error of at most 1/256.
class BriefFloat {
public:
    /// 0.
    constexpr BriefFloat() = default;
    /// Rounds to the nearest, ties to even. Finite numbers only.
    constexpr BriefFloat(float value) {
        const auto bits = std::bit_cast<std::uint32_t>(value);
        const std::uint32_t rounded = (bits + 0x7fffu + (bits >> 16 & 1u)) >> 16;
        bits_ = static_cast<std::uint16_t>(rounded);
    }
    /// The number, exactly as it is kept.
    constexpr operator float() const { return std::bit_cast<float>(std::uint32_t{bits_} << 16); }

private:
    std::uint16_t bits_ = 0;
};

/// Of each lobe its radiance by channel over their mean, to within 1/256: white at first.
class LobeColours {
public:
    /// White.
    LobeColours() {
        red_.fill(1.0f);
        blue_.fill(1.0f);
    }

    /// A colour of mean 1; channels are not negative.
    void set(int lobe, float red, float blue) {
        red_[static_cast<std::size_t>(lobe)] = red;
        blue_[static_cast<std::size_t>(lobe)] = blue;
    }
    /// The colour of a lobe, of mean 1; green is what red and blue leave.
    Rgb operator[](int lobe) const {
        const float red = red_[static_cast<std::size_t>(lobe)], blue = blue_[static_cast<std::size_t>(lobe)];
        return {red, std::max(0.0f, 3 - red - blue), blue};
    }

private:
    std::array<BriefFloat, max_lobes> red_, blue_;
};

/// The share of classical sampling where nothing is known.
inline constexpr float unproven_defensive_fraction = 0.3f;

/// The learned adjoint in one cell. The mixture belongs to a reference point; seen from elsewhere in the cell, lobes
/// whose distance is known turn to keep pointing at their source.
class Region {
public:
    /// Knows nothing: no radiance, equally from everywhere.
    Region() = default;

    /// `inverse_distance`: 1/distance of each lobe's source from the reference point; 0 where it is far or not known.
    Region(const Vec3& reference, const VmfMixture& mixture, const Lanes& inverse_distance, float fluence,
           const LobeColours& colours = {}, float defensive_fraction = unproven_defensive_fraction)
        : reference_(reference),
          fluence_(fluence),
          mixture_(mixture),
          inverse_distance_(inverse_distance),
          colours_(colours),
          defensive_fraction_(defensive_fraction) {}

    /// Distribution of the incident radiance at a position of the cell, as a view of this region.
    MixtureView incident(const Vec3& position) const {
        return MixtureView(mixture_, reference_ - position, inverse_distance_);
    }

    /// ∫ L dω averaged over the cell's records, in radiance times sr.
    float fluence() const { return fluence_; }

    /// ∫ f L dω by colour channel, for a product of what is incident somewhere in the cell with the lobes of f: each
    /// lobe brings its own colour.
    Rgb in_scattered(const MixtureProduct& product) const {
        Rgb sum;
        if (product.integral() > 0) {
            for (int i = 0; i < mixture_.size(); ++i) {
                sum += colours_[i] * (fluence_ * product.parts()[i]);
            }
        }
        return sum;
    }

    /// Radiance arriving at a position of the cell from a unit direction, by colour channel.
    Rgb radiance(const Vec3& position, const Vec3& direction) const {
        const VmfMixture seen = incident(position);
        Rgb sum;
        for (int i = 0; i < seen.size(); ++i) {
            const auto [weight, vmf] = seen.lobe(i);
            sum += colours_[i] * (fluence_ * weight * vmf.density(direction));
        }
        return sum;
    }

    /// How much of directions is best drawn by classical sampling, as measured (share.h).
    float defensive_fraction() const { return defensive_fraction_; }

    /// The point that mixture() belongs to.
    const Vec3& reference() const { return reference_; }
    /// The incident radiance as seen from the reference point: incident() gives it for others.
    const VmfMixture& mixture() const { return mixture_; }
    /// By lobe, 1/distance of its source from the reference point; 0 where it is far or not known.
    const Lanes& inverse_distance() const { return inverse_distance_; }
    /// By lobe, its radiance by channel over their mean.
    const LobeColours& colours() const { return colours_; }

private:
    Vec3 reference_{0, 0, 0};
    float fluence_ = 0;
    VmfMixture mixture_;
    Lanes inverse_distance_;
    LobeColours colours_;
    float defensive_fraction_ = unproven_defensive_fraction;
};

static_assert(IncidentRadiance<VmfMixture>);
static_assert(IncidentRadiance<MixtureView>);
static_assert(Adjoint<Region>);

/// Light that arrives from everywhere, known by its amount and its mean direction alone.
struct ArrivingLight {
    /// ∫ L dω, in radiance times sr.
    float fluence = 0;
    /// ∫ ω L dω / ∫ L dω, shorter than 1: towards where the light comes from.
    Vec3 mean{0, 0, 0};
};

/// How many sides are distinguished: three axes, two signs.
inline constexpr int sides = 6;
/// The side of a surface, in [0, sides): twice the axis that is nearest to its normal, plus 1 if that points down it.
inline int side_of(const Vec3& normal) {
    const Vec3 size(std::abs(normal.x), std::abs(normal.y), std::abs(normal.z));
    const int axis = size.x >= size.y ? (size.x >= size.z ? 0 : 2) : (size.y >= size.z ? 1 : 2);
    return 2 * axis + (normal[axis] < 0 ? 1 : 0);
}

/// Lights close to a cell, taken for one. What arrives from them grows as 1/r² towards them, which no mean over the
/// cell tells.
struct NearLight {
    /// Where they are, as a mean.
    Vec3 position{0, 0, 0};
    /// The mean of the squared distances of its parts from the position.
    float extent_squared = 0;
    /// Fluence times squared distance, a mean over the cell, in radiance times sr times squared length; 0: there is no
    /// such light.
    float intensity = 0;
    /// How much of what connections found it has.
    float share = 0;
};

/// The light scattered in a cell. As a function of direction, what arrives is taken for Henyey and Greenstein's
/// function around its mean direction: that kind is closed under convolution, so the in-scattered radiance for a phase
/// function of that kind costs one evaluation.
struct ScatteredLight {
    /// What walks found on their way.
    ArrivingLight walked;
    /// What their connections to lights found: together with `walked` all the light.
    ArrivingLight connected;
    /// Part of what was connected.
    NearLight near;
    /// How far the cell is to be trusted, 0 to 1: a handful of bright records among dark ones may be chance.
    float confidence = 0;

    /// ∫ p(before, ω) L(ω) dω, in radiance. The phase function is a PhaseFunction or one of its kinds.
    template <class Phase>
    float in_scattered(const Vec3& before, const Phase& phase) const {
        return in_scattered(before, phase, 1);
    }
    /// The same without the near light's.
    template <class Phase>
    float in_scattered_from_afar(const Vec3& before, const Phase& phase) const {
        return in_scattered(before, phase, 1 - near.share);
    }

private:
    template <class Phase>
    float in_scattered(const Vec3& before, const Phase& phase, float share_of_connected) const {
        return walked.fluence * phase.convolved(before, walked.mean) +
               share_of_connected * connected.fluence * phase.convolved(before, connected.mean);
    }
};

/// Sums over the records of a cell, older ones counting less.
struct ScatterSums {
    /// How many there were, by side.
    std::array<float, sides> records{};
    /// ScatterRecord::leaving, by side.
    std::array<float, sides> leaving{};
    /// ScatterRecord::connected.
    float connected = 0;
    /// The same times ScatterRecord::to_light.
    Vec3 connected_direction{0, 0, 0};

    /// How many records there were on all sides.
    float all_records() const { return std::accumulate(records.begin(), records.end(), 0.0f); }

    /// Mean radiance that leaves the vertices of the cell towards where walks came from, by the side that they came
    /// from: a wall may be bright on one side and dark on the other. 0 without records.
    float leaving_to(const Vec3& normal) const {
        const float all = all_records();
        if (!(all > 0)) {
            return 0;
        }
        // What is known of a side that few saw is little: it is drawn to the mean.
        constexpr float prior = 4;
        const float mean = std::accumulate(leaving.begin(), leaving.end(), 0.0f) / all;
        const auto side = static_cast<std::size_t>(side_of(normal));
        return (leaving[side] + prior * mean) / (records[side] + prior);
    }

    /// All sums times a factor: what is older counts less.
    ScatterSums scaled(float factor) const {
        ScatterSums result = *this;
        for (std::size_t side = 0; side < sides; ++side) {
            result.records[side] *= factor;
            result.leaving[side] *= factor;
        }
        result.connected *= factor;
        result.connected_direction *= factor;
        return result;
    }
    /// Adds the sums over other records.
    ScatterSums& operator+=(const ScatterSums& o) {
        for (std::size_t side = 0; side < sides; ++side) {
            records[side] += o.records[side];
            leaving[side] += o.leaving[side];
        }
        connected += o.connected;
        connected_direction += o.connected_direction;
        return *this;
    }
};

}  // namespace wend::guide
