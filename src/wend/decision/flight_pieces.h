// The density of a flight's distance that follows an estimate of what lies ahead.
#pragma once

#include <wend/decision/channels.h>

namespace wend {

/// Flights along a ray that is cut into pieces, in each of which the density of the medium and the light scattered
/// there are taken for constant (herholz2019, with all integrals in closed form). A collision at distance t in a piece
/// of density d and in-scattered radiance S, an optical depth of σ x from the start, is drawn with density
///     d · (α Σ_c w_c σ_c e^{-σ_c x} + (1 - α) S / Z · Σ_c w_c σs_c e^{-σ_c x}),
/// and the end, behind which radiance A comes, with probability
///     α Σ_c w_c e^{-σ_c X} + (1 - α) A / Z · Σ_c w_c e^{-σ_c X},
/// where α is the classical share, w_c are the weights of the colour channels and Z makes the second terms add up to 1.
/// A value of fixed size without heap memory.
class FlightPieces {
public:
    /// A place in a flight and its density or, at the end, probability.
    struct Outcome {
        bool scatters = false;
        float distance = 0;
        /// Optical depth for an extinction of 1.
        float depth = 0;
        float density = 0;
        /// What it would be with a classical share of 1.
        float classical = 0;
    };

    /// Coefficients at density 1, and weights of the channels that add up to 1.
    FlightPieces(const Rgb& extinction, const Rgb& scattering, const Rgb& channels);

    /// The next piece, behind the last one; what is between them is empty. `density` and `in_scattered` are not
    /// negative. Beyond the room for pieces, or where hardly any light gets to, it is joined to the last one.
    void add(float t_in, float t_out, float density, float in_scattered);

    /// Nothing more comes before the end, where `ahead` is the radiance to be expected. `level`: only whether to
    /// scatter follows the light, and where does not.
    void finish(float length, float ahead, bool level);

    /// Draws a flight; `u` picks the technique and what it needs. With a classical share below 1, the pieces must not
    /// all be dark.
    Outcome sample(float classical_share, float u) const;

    /// The density of a collision at a distance inside a piece, or of the end.
    Outcome collision(float distance, float classical_share) const;
    Outcome end(float classical_share) const;

    /// Whether there is anything to be guided to.
    bool is_lit() const { return total_ > 0; }

private:
    struct Piece {
        float t_in, t_out;
        float density;
        float in_scattered;
        /// Optical depth at t_in for an extinction of 1.
        float depth;
        /// Sum of the contributions up to the end of the piece.
        float cumulative;
    };

    float depth_after(const Piece& piece) const { return piece.depth + piece.density * (piece.t_out - piece.t_in); }
    /// e^{-σ_c depth}.
    Rgb transmitted(float depth) const;
    float attenuated(const Rgb& weights, float depth) const { return dot(weights, transmitted(depth)); }
    /// w_c σs_c ∫ e^{-σ_c x} over the piece.
    Rgb scattered_in(const Piece& piece) const;
    Outcome collision_in(const Piece& piece, float depth, float classical_share) const;

    static constexpr int capacity = 160;

    Rgb extinction_;
    /// w_c times σ_c, σs_c, 1 and σs_c / σ_c.
    Rgb rate_, scattering_rate_, channels_, albedo_;
    bool grey_;
    int count_ = 0;
    float length_ = 0;
    float depth_ = 0;
    float ahead_ = 0;
    float total_ = 0;
    Piece pieces_[capacity];
};

}  // namespace wend
