// Null-collision tracking that knows what lies ahead.
#pragma once

#include <wend/decision/distance.h>

namespace wend {

/// Delta tracking through a grid in which a tentative collision is taken for a real one in proportion to the light that
/// is scattered there, over that and what the flight would find if it went on; where much light is scattered, tentative
/// collisions come more often. The ray is cut into pieces, in each of which the in-scattered radiance is taken for
/// constant, and the density for its mean where the light ahead is foretold: the real density and majorant alone make the
/// weight. With uniform light this is classical tracking, and has no noise of its own; ratio tracking at the other end,
/// where nothing is scattered. A value of fixed size without heap memory.
class GuidedTracking {
public:
    /// `classical_share` in (0, 1]: real and null collisions keep this share of their classical probability. All are
    /// referred to.
    GuidedTracking(const GridMedium& medium, const FlightStart& start, float classical_share);

    /// The next piece, behind the last one; what is between them is empty. Beyond the room for pieces it is joined to
    /// the last one.
    void add(float t_in, float t_out, const MajorantGrid::Cell& cell, float in_scattered);

    /// `ahead` is the radiance to be expected at the end of the segment. `level`: only whether to scatter follows the
    /// light, and where does not.
    Flight fly(float ahead, bool level, Pcg32& random);

private:
    struct Piece {
        float t_in, t_out;
        MajorantGrid::Cell density;
        float in_scattered;
        /// Radiance to be expected behind the piece.
        float behind = 0;
    };

    /// Radiance to be expected on the last part of a piece.
    float expected(const Piece& piece, float length) const;
    void look_ahead(float ahead);
    void level_out();

    static constexpr int capacity = 256;

    const GridMedium& medium_;
    const FlightStart& start_;
    float classical_share_;
    /// Means over the colour channels, at density 1, by what the walk carries.
    float extinction_, albedo_;
    int count_ = 0;
    Piece pieces_[capacity];
};

}  // namespace wend
