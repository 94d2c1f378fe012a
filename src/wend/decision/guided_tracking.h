// Null-collision tracking that knows what lies ahead.
#pragma once

#include <wend/decision/distance.h>

namespace wend {

/// Delta tracking through a grid in which a tentative collision is taken for a real one in proportion to the light that
/// is scattered there, over that and what the flight would find if it went on; where much light is scattered, tentative
/// collisions come more often. The light ahead is foretold from pieces, the medium's majorant cells, in which the
/// in-scattered radiance is taken for constant and the density for its mean; the weight knows the real density alone.
/// With uniform light this is classical tracking, and has no noise of its own; it is ratio tracking at the other end,
/// where nothing is scattered. What few flights reach is flown classically. A value of fixed size without heap memory.
class GuidedTracking {
public:
    /// `defensive_fraction` in (0, 1]: real and null collisions keep this share of their classical probability. Both
    /// are referred to.
    GuidedTracking(const GridMedium& medium, const FlightStart& start, float defensive_fraction);

    /// To where along the ray the light is to be told; 0 in an empty medium.
    float reach() const { return count_ > 0 ? pieces_[count_ - 1].t_out : 0.0f; }

    /// Tells the in-scattered radiance up to a distance, from the last one on.
    void light_up_to(float t_out, float in_scattered) {
        for (; lit_ < count_ && 0.5f * (pieces_[lit_].t_in + pieces_[lit_].t_out) < t_out; ++lit_) {
            pieces_[lit_].in_scattered = in_scattered;
        }
    }

    /// To be called once the light is told as far as it is to be. `ahead` is the radiance to be expected at the end of
    /// the segment. `level`: only whether to scatter follows the light, and where does not.
    Flight fly(float ahead, bool level, Pcg32& random);

private:
    struct Piece {
        float t_in, t_out;
        MajorantGrid::Cell density;
        float in_scattered;
        /// Radiance to be expected behind the piece.
        float behind;
    };

    /// Radiance to be expected on the last part of a piece.
    float expected(const Piece& piece, float length) const;
    void look_ahead(float ahead);
    void level_out();

    static constexpr int capacity = 128;

    const GridMedium& medium_;
    const FlightStart& start_;
    float defensive_fraction_;
    /// Means over the colour channels, at density 1, by what the walk carries.
    float extinction_, albedo_;
    int count_ = 0;
    int lit_ = 0;
    /// Whether the pieces end before the segment does.
    bool goes_on_ = false;
    Piece pieces_[capacity];
};

}  // namespace wend
