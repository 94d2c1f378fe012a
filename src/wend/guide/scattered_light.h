// What a cell of the field tells a ray that passes through: how much light is scattered into it there.
#pragma once

#include <wend/core/vector.h>
#include <wend/medium/phase.h>

#include <array>
#include <cmath>
#include <cstddef>
#include <numeric>

namespace wend::guide {

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
