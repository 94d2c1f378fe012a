#include <wend/decision/flight_pieces.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace wend {
namespace {

// e^{-depth} of what is behind is no more than rounding.
constexpr float deepest = 40;

/// 1 - e^{-depth}. Thin pieces are the usual ones: their series is faster than expm1.
float stopped(float depth) {
    return depth < 0.1f ? depth * (1 - depth * (0.5f - depth * (1.0f / 6 - depth * (1.0f / 24 - depth * (1.0f / 120)))))
                        : 1 - std::exp(-depth);
}

}  // namespace

FlightPieces::FlightPieces(const Rgb& extinction, const Rgb& scattering, const Rgb& channels)
    : extinction_(extinction),
      rate_(extinction * channels),
      scattering_rate_(scattering * channels),
      channels_(channels),
      grey_(extinction.r == extinction.g && extinction.g == extinction.b) {
    for (int c = 0; c < 3; ++c) {
        albedo_[c] = extinction[c] > 0 ? channels[c] * scattering[c] / extinction[c] : 0.0f;
    }
}

Rgb FlightPieces::transmitted(float depth) const {
    return grey_ ? Rgb(std::exp(-extinction_.r * depth)) : exp(extinction_ * -depth);
}

void FlightPieces::add(float t_in, float t_out, float density, float in_scattered) {
    const bool full = count_ == capacity || (count_ > 0 && depth_ * min_value(extinction_) > deepest);
    if (full) {
        Piece& last = pieces_[count_ - 1];
        const float before = last.t_out - last.t_in, more = t_out - t_in;
        const float whole = t_out - last.t_in;
        last.density = (last.density * before + density * more) / whole;
        last.in_scattered = (last.in_scattered * before + in_scattered * more) / (before + more);
        last.t_out = t_out;
        depth_ = depth_after(last);
        return;
    }
    pieces_[count_] = {t_in, t_out, density, in_scattered, depth_, 0};
    depth_ = depth_after(pieces_[count_++]);
}

Rgb FlightPieces::scattered_in(const Piece& piece) const {
    // Not as a difference of transmittances, of which nothing would be left in a thin medium.
    const float size = piece.density * (piece.t_out - piece.t_in);
    const Rgb share =
        grey_ ? Rgb(stopped(extinction_.r * size))
              : Rgb(stopped(extinction_.r * size), stopped(extinction_.g * size), stopped(extinction_.b * size));
    return albedo_ * transmitted(piece.depth) * share;
}

void FlightPieces::finish(float length, float ahead, bool level) {
    length_ = length;
    ahead_ = ahead;
    float scattered = 0, lit = 0;
    for (int i = 0; i < count_; ++i) {
        Piece& piece = pieces_[i];
        const float part = dot(Rgb(1.0f), scattered_in(piece));
        scattered += part;
        lit += piece.in_scattered * part;
        piece.cumulative = level ? scattered : lit;
    }
    if (level && scattered > 0) {
        const float mean = lit / scattered;
        for (int i = 0; i < count_; ++i) {
            pieces_[i].in_scattered = mean;
            pieces_[i].cumulative *= mean;
        }
    }
    total_ = (count_ > 0 ? pieces_[count_ - 1].cumulative : 0.0f) + ahead * attenuated(channels_, depth_);
}

FlightPieces::Outcome FlightPieces::collision_in(const Piece& piece, float depth, float classical_share) const {
    Outcome o;
    o.scatters = true;
    o.depth = depth;
    o.distance = std::clamp(piece.t_in + (depth - piece.depth) / piece.density, piece.t_in, piece.t_out);
    const Rgb passed = transmitted(depth);
    o.classical = piece.density * dot(rate_, passed);
    o.density = classical_share * o.classical;
    if (classical_share < 1) {
        o.density +=
            (1 - classical_share) * piece.density * piece.in_scattered / total_ * dot(scattering_rate_, passed);
    }
    return o;
}

FlightPieces::Outcome FlightPieces::collision(float distance, float classical_share) const {
    for (int i = 0; i < count_; ++i) {
        const Piece& piece = pieces_[i];
        if (distance >= piece.t_in && distance < piece.t_out) {
            return collision_in(piece, piece.depth + piece.density * (distance - piece.t_in), classical_share);
        }
    }
    return {true, distance, 0, 0, 0};
}

FlightPieces::Outcome FlightPieces::end(float classical_share) const {
    Outcome o;
    o.distance = length_;
    o.depth = depth_;
    const Rgb passed = transmitted(depth_);
    o.classical = dot(channels_, passed);
    o.density = classical_share * o.classical;
    if (classical_share < 1) {
        o.density += (1 - classical_share) * ahead_ / total_ * o.classical;
    }
    return o;
}

FlightPieces::Outcome FlightPieces::sample(float classical_share, float u) const {
    const auto rescaled = [](float v) { return std::clamp(v, 0.0f, 0x1.fffffep-1f); };
    if (u < classical_share) {
        u = rescaled(u / classical_share);
        const float rate = extinction_[choose_channel(channels_, u)];
        const float depth = rate > 0 ? -std::log1p(-u) / rate : std::numeric_limits<float>::infinity();
        const Piece* piece =
            std::partition_point(pieces_, pieces_ + count_, [&](const Piece& p) { return depth_after(p) <= depth; });
        return piece == pieces_ + count_ ? end(classical_share) : collision_in(*piece, depth, classical_share);
    }
    u = rescaled((u - classical_share) / (1 - classical_share)) * total_;
    const Piece* piece =
        std::partition_point(pieces_, pieces_ + count_, [&](const Piece& p) { return p.cumulative <= u; });
    if (piece == pieces_ + count_) {
        return end(classical_share);
    }
    const float before = piece == pieces_ ? 0.0f : (piece - 1)->cumulative;
    u = rescaled((u - before) / (piece->cumulative - before));
    // Which channel's share of the piece.
    const int channel = grey_ ? 0 : choose_channel(channel_probabilities(scattered_in(*piece)), u);
    const float sigma = extinction_[channel], size = piece->density * (piece->t_out - piece->t_in);
    const float depth = piece->depth - std::log1p(u * std::expm1(-sigma * size)) / sigma;
    return collision_in(*piece, std::min(depth, depth_after(*piece)), classical_share);
}

}  // namespace wend
