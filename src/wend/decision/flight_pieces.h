// The density of a flight's distance through a homogeneous medium that follows an estimate of what lies ahead, and the
// lights close by and their beams that it follows as well.
#pragma once

#include <wend/core/export.h>
#include <wend/core/vector.h>
#include <wend/decision/channels.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>

namespace wend {

/// What a spot light lights, but for what stands in its way.
struct Beam {
    Vec3 position;        ///< of the lamp, in scene units
    Vec3 axis;            ///< unit length, the way that it shines
    float cosine = 1;     ///< of half the cone's angle, above 0
    float intensity = 0;  ///< power per steradian, mean of the channels, along the axis
    /// In-scattered radiance, per unit of scattering, that may be expected of other lamps where nothing is learned yet.
    float others = 0;
};

/// A part of a ray.
struct RayInterval {
    float t_in;   ///< distance of its beginning
    float t_out;  ///< distance of its end
};

/// Where the first `length` of a ray with a unit direction is in the cone; none where it is not. The cone is convex.
WEND_API std::optional<RayInterval> crossing(const Beam& beam, const Ray& ray, float length);

/// How a ray passes a light by. A light that is no point is one that it passes by further away.
class ClosestApproach {
public:
    /// `extent_squared`: the mean of the squared distances of the light's parts from `light`, not negative. The
    /// direction of the ray is a unit vector.
    ClosestApproach(const Ray& ray, const Vec3& light, float extent_squared) {
        const Vec3 towards = light - ray.origin;
        along_ = dot(towards, ray.direction);
        // What passes closer than this cannot be told from a hit.
        constexpr float least = 1e-8f;
        beside_squared_ = length_squared(towards - ray.direction * along_) + extent_squared +
                          least * length_squared(towards) + 1e-30f;
    }

    /// Where along the ray the light is closest, before its origin if negative, and how far away it is there.
    float along() const { return along_; }
    /// How far away that is.
    float beside() const { return std::sqrt(beside_squared_); }
    /// The squared distance of the light.
    float squared_distance(float t) const { return beside_squared_ + sqr(t - along_); }
    /// The cosine of the ray to the light's direction.
    float cosine(float t) const { return (along_ - t) / std::sqrt(squared_distance(t)); }

    /// Whether the light is no more than twice as far from one place between t_in and t_out as from another.
    bool is_about_as_far(float t_in, float t_out) const {
        const float farthest = std::max(squared_distance(t_in), squared_distance(t_out));
        return farthest <= 4 * squared_distance(std::clamp(along_, t_in, t_out));
    }
    /// The mean of 1/r² there, by Simpson's rule.
    float mean_inverse_square(float t_in, float t_out) const {
        const float in = squared_distance(t_in), middle = squared_distance(0.5f * (t_in + t_out)),
                    out = squared_distance(t_out);
        return (1 / in + 4 / middle + 1 / out) / 6;
    }

private:
    float along_, beside_squared_;
};

/// Distances from t_in to t_out along a ray, drawn by the angle under which a light sees them (kulla2012): with density
/// in proportion to 1 / r², r the distance to the light.
class Equiangular {
public:
    /// 0 <= t_in < t_out, which may be infinite.
    Equiangular(const ClosestApproach& approach, float t_in, float t_out)
        : t_in_(t_in), t_out_(std::min(t_out, farthest)), closest_(approach.along()), distance_(approach.beside()) {
        const float before = t_in_ - closest_, behind = t_out_ - closest_;
        angle_ = std::atan2(distance_ * (t_out_ - t_in_), sqr(distance_) + before * behind);
    }

    /// `u` in [0,1).
    float sample(float u) const {
        const float begin = std::atan((t_in_ - closest_) / distance_);
        return std::clamp(closest_ + distance_ * std::tan(begin + u * angle_), t_in_, t_out_);
    }
    /// 0 outside of the interval.
    float density(float t) const {
        const float square = sqr(distance_) + sqr(t - closest_);
        return t >= t_in_ && t <= t_out_ && angle_ > 0 ? distance_ / (angle_ * square) : 0.0f;
    }
    /// ∫ dt / r² over the interval.
    float integral() const { return angle_ / distance_; }
    /// Where the light is closest in the interval.
    float closest() const { return std::clamp(closest_, t_in_, t_out_); }
    /// The cosine of the ray to the light's direction in the middle of the angle.
    float cosine() const {
        const float before = t_in_ - closest_, behind = t_out_ - closest_;
        const float a = 1 / std::sqrt(sqr(distance_) + sqr(before)), b = 1 / std::sqrt(sqr(distance_) + sqr(behind));
        const float along = a * before + b * behind, across = distance_ * (a + b);
        return -along / std::sqrt(sqr(along) + sqr(across));
    }

private:
    /// Its square is a number.
    static constexpr float farthest = 1e15f;

    float t_in_, t_out_;
    float closest_, distance_;
    float angle_;
};

/// Flights along a ray that is cut into pieces, in each of which the in-scattered radiance is taken for constant
/// (herholz2019, with all integrals in closed form). A collision at distance t in a piece of in-scattered radiance S is
/// drawn with density
///     α Σ_c w_c σ_c e^{-σ_c t} + (1 - α) S / Z · Σ_c w_c σs_c e^{-σ_c t},
/// and the end at distance d, behind which radiance A comes, with probability
///     (α + (1 - α) A / Z) · Σ_c w_c e^{-σ_c d},
/// where α is the classical share, w_c are the weights of the colour channels and Z makes the second terms add up to 1.
/// A light close to a piece adds what its light brings there, drawn by angle (kulla2012), to the second term of the
/// density; so does one whose beam the ray crosses.
/// A value of fixed size without heap memory.
class WEND_API FlightPieces {
public:
    /// A place in a flight and its density or, at the end, probability.
    struct Outcome {
        bool scatters = false;  ///< whether it is a collision
        float distance = 0;     ///< from the beginning
        float density = 0;      ///< per unit length; at the end a probability
        /// What it would be with a classical share of 1.
        float classical = 0;
    };

    /// The coefficients, and weights of the channels that add up to 1.
    FlightPieces(const Rgb& extinction, const Rgb& scattering, const Rgb& channels);

    /// The next piece: from the end of the last one, at first from 0, to t_out. Returns whether more pieces are wanted:
    /// there is room for so many, and hardly any light comes from far away.
    bool add(float t_out, float in_scattered);

    /// The next piece has a light close by, of this in-scattered radiance times squared distance. There must be room.
    void add_near(const Equiangular& along, float strength);
    /// For another light that is close by.
    bool has_room_for_near() const { return near_count_ - beam_count_ < most_near; }

    /// A light whose beam the ray crosses there, of this in-scattered radiance times squared distance. Before the first
    /// piece, and as long as there is room.
    void add_beam(const Equiangular& along, float strength);
    /// For another beam.
    bool has_room_for_beam() const { return beam_count_ < most_beams; }

    /// No more pieces: the last one ends with the segment, at `length`, where `ahead` is the radiance to be expected.
    /// There must be a piece. `level`: only whether to scatter follows the light, and where does not.
    void finish(float length, float ahead, bool level);

    /// Draws a flight; `u` in [0,1) picks the technique and what it needs. The classical share is in [0,1], and 1 where
    /// nothing is lit.
    Outcome sample(float defensive_fraction, float u) const;

    /// The density of a collision within the segment, and the probability of the end.
    Outcome collision(float distance, float defensive_fraction) const;
    /// See collision().
    Outcome end(float defensive_fraction) const;

    /// Whether there is anything to be guided to.
    bool is_lit() const { return total_ > 0; }

private:
    struct Piece {
        float t_out;
        float in_scattered;
        /// Sum of the contributions up to the end of the piece.
        float cumulative;
    };

    struct Near {
        static constexpr std::ptrdiff_t anywhere = -1;

        std::ptrdiff_t piece;  ///< that it is close to; a beam crosses several
        Equiangular along;
        /// The contribution, and the sum of all up to this one, those of the pieces included.
        float part, cumulative;
    };

    /// Of what comes to a piece: e^{-σ_c t}, t the length of the piece, and the rest with all its digits, of which a
    /// difference would leave nothing in a thin medium.
    struct Shares {
        Rgb passing, stopped;
    };

    Rgb transmitted(float distance) const;
    float t_in(const Piece& piece) const { return &piece == pieces_ ? 0.0f : (&piece - 1)->t_out; }
    Shares shares_in(const Piece& piece) const;
    Outcome collision_in(const Piece& piece, float distance, float defensive_fraction) const;
    /// The contributions of the piece's near light and of beams, per unit of distance.
    float near_at(const Piece& piece, float distance) const;

    static constexpr int capacity = 128;
    static constexpr int most_near = 8, most_beams = 4;

    Rgb extinction_;
    /// The weights of the channels times 1, σ, σs, and σs / σ.
    Rgb channels_, rate_, scattering_rate_, albedo_;
    bool grey_;
    float farthest_;
    int count_ = 0, near_count_ = 0, beam_count_ = 0;
    float ahead_ = 0;
    float total_ = 0;
    Piece pieces_[capacity];
    std::optional<Near> near_[most_near + most_beams];  ///< beams first
};

}  // namespace wend
