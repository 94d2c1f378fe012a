#include <wend/decision/flight_pieces.h>

#include <wend/core/contracts.h>
#include <wend/numeric/fast_math.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace wend {
namespace {

// The optical depth to which cells are told apart.
constexpr float deepest = 50;

float into_unit(float u) {
    return std::clamp(u, 0.0f, 0x1.fffffep-1f);
}

/// What is so little is never drawn: close to the least of numbers no channel can be told from another.
float or_nothing(float part) {
    constexpr float least = 1e-30f;
    return part >= least ? part : 0.0f;
}

FastPower passing(float depth) {
    return fast_power_of_two(-std::numbers::log2e_v<float> * depth);
}

}  // namespace

FlightPieces::FlightPieces(const Rgb& extinction, const Rgb& scattering, const Rgb& channels)
    : extinction_(extinction),
      channels_(channels),
      rate_(extinction * channels),
      scattering_rate_(scattering * channels),
      grey_(extinction.r == extinction.g && extinction.g == extinction.b),
      farthest_(deepest / min_value(extinction)) {
    for (int c = 0; c < 3; ++c) {
        albedo_[c] = extinction[c] > 0 ? scattering_rate_[c] / extinction[c] : 0.0f;
    }
}

Rgb FlightPieces::transmitted(float distance) const {
    return grey_ ? Rgb(std::exp(-extinction_.r * distance)) : exp(extinction_ * -distance);
}

FlightPieces::Shares FlightPieces::shares_in(const Piece& piece) const {
    const float size = piece.t_out - t_in(piece);
    const FastPower r = passing(extinction_.r * size);
    if (grey_) {
        return {Rgb(r.value()), Rgb(-r.minus_one())};
    }
    const FastPower g = passing(extinction_.g * size), b = passing(extinction_.b * size);
    return {{r.value(), g.value(), b.value()}, {-r.minus_one(), -g.minus_one(), -b.minus_one()}};
}

bool FlightPieces::add(float t_out, float in_scattered) {
    pieces_[count_++] = {t_out, in_scattered, 0};
    return t_out < farthest_ && count_ < capacity;
}

void FlightPieces::add_near(const Equiangular& along, float strength) {
    WEND_EXPECT(has_room_for_near());
    near_[near_count_++] = {count_, along, strength * along.integral(), 0};
}

void FlightPieces::add_beam(const Equiangular& along, float strength) {
    WEND_EXPECT(has_room_for_beam() && count_ == 0);
    near_[near_count_++] = {Near::anywhere, along, strength * along.integral(), 0};
    ++beam_count_;
}

void FlightPieces::finish(float length, float ahead, bool level) {
    WEND_EXPECT(count_ > 0);
    pieces_[count_ - 1].t_out = length;
    ahead_ = ahead;
    float scattered = 0, lit = 0;
    Rgb passed(1.0f);
    for (int i = 0; i < count_; ++i) {
        Piece& piece = pieces_[i];
        const Shares shares = shares_in(piece);
        const float part = or_nothing(dot(albedo_ * passed, shares.stopped));
        passed *= shares.passing;
        scattered += part;
        lit += or_nothing(piece.in_scattered * part);
        piece.cumulative = lit;
    }
    for (int i = 0; i < near_count_; ++i) {
        Near& near = *near_[i];
        near.part = or_nothing(near.part * dot(scattering_rate_, transmitted(near.along.closest())));
        lit += near.part;
        near.cumulative = lit;
    }
    if (level && lit > 0) {
        pieces_[0] = {length, lit / scattered, lit};
        count_ = 1;
        near_count_ = beam_count_ = 0;
    }
    total_ = or_nothing(lit + ahead * dot(channels_, passed));
}

float FlightPieces::near_at(const Piece& piece, float distance) const {
    float sum = 0;
    for (int i = 0; i < near_count_; ++i) {
        if (near_[i]->piece == &piece - pieces_ || near_[i]->piece == Near::anywhere) {
            sum += near_[i]->part * near_[i]->along.density(distance);
        }
    }
    return sum;
}

FlightPieces::Outcome FlightPieces::collision_in(const Piece& piece, float distance, float defensive_fraction) const {
    const Rgb passed = transmitted(distance);
    Outcome o{true, distance, 0, dot(rate_, passed)};
    o.density = defensive_fraction * o.classical;
    if (defensive_fraction < 1) {
        o.density += (1 - defensive_fraction) / total_ *
                     (piece.in_scattered * dot(scattering_rate_, passed) + near_at(piece, distance));
    }
    return o;
}

FlightPieces::Outcome FlightPieces::collision(float distance, float defensive_fraction) const {
    const Piece* piece =
        std::partition_point(pieces_, pieces_ + count_ - 1, [&](const Piece& p) { return p.t_out <= distance; });
    return collision_in(*piece, distance, defensive_fraction);
}

FlightPieces::Outcome FlightPieces::end(float defensive_fraction) const {
    const float length = pieces_[count_ - 1].t_out;
    Outcome o{false, length, 0, dot(channels_, transmitted(length))};
    o.density =
        o.classical * (defensive_fraction < 1 ? defensive_fraction + (1 - defensive_fraction) * ahead_ / total_ : 1.0f);
    return o;
}

FlightPieces::Outcome FlightPieces::sample(float defensive_fraction, float u) const {
    const float length = pieces_[count_ - 1].t_out;
    if (u < defensive_fraction) {
        u = into_unit(u / defensive_fraction);
        const float rate = extinction_[choose_channel(channels_, u)];
        const float distance = rate > 0 ? -std::log1p(-u) / rate : std::numeric_limits<float>::infinity();
        return distance < length ? collision(distance, defensive_fraction) : end(defensive_fraction);
    }
    u = into_unit((u - defensive_fraction) / (1 - defensive_fraction)) * total_;
    const Piece* piece =
        std::partition_point(pieces_, pieces_ + count_, [&](const Piece& p) { return p.cumulative <= u; });
    if (piece == pieces_ + count_) {
        const auto* near =
            std::find_if(near_, near_ + near_count_, [&](const auto& candidate) { return candidate->cumulative > u; });
        if (near == near_ + near_count_) {
            return end(defensive_fraction);
        }
        u = into_unit((u - ((*near)->cumulative - (*near)->part)) / (*near)->part);
        const float distance = (*near)->along.sample(u);
        return (*near)->piece == Near::anywhere ? collision(distance, defensive_fraction)
                                                : collision_in(pieces_[(*near)->piece], distance, defensive_fraction);
    }
    const float below = piece == pieces_ ? 0.0f : (piece - 1)->cumulative;
    u = into_unit((u - below) / (piece->cumulative - below));
    const float from = t_in(*piece), size = piece->t_out - from;
    // Which channel's share of the piece.
    const int channel =
        grey_ ? 0 : choose_channel(channel_probabilities(albedo_ * transmitted(from) * shares_in(*piece).stopped), u);
    const float sigma = extinction_[channel];
    const float distance = from - std::log1p(u * std::expm1(-sigma * size)) / sigma;
    return collision_in(*piece, std::min(distance, piece->t_out), defensive_fraction);
}

}  // namespace wend
