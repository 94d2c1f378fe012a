#include <wend/decision/guided_tracking.h>

#include <wend/decision/channels.h>
#include <wend/decision/dense_flight.h>
#include <wend/medium/tentative_collisions.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

// How many times more tentative collisions than the majorant's there may be.
constexpr float most_stretching = 4;
// The optical depth to which the light is asked for.
constexpr float deepest = 3;

}  // namespace

GuidedTracking::GuidedTracking(const GridMedium& medium, const FlightStart& start, float defensive_fraction)
    : medium_(medium), start_(start), defensive_fraction_(defensive_fraction) {
    const Rgb channels = channel_probabilities(start.throughput);
    extinction_ = dot(channels, medium.extinction());
    albedo_ = extinction_ > 0 ? dot(channels, medium.scattering()) / extinction_ : 0.0f;
    const auto index_ray = medium.to_index(start.ray);
    float depth = 0;
    medium.majorants().walk(index_ray.origin, index_ray.direction, 0, start.length,
                            [&](const MajorantGrid::Cell& cell, float t_in, float t_out) {
                                if (cell.maximum > 0) {
                                    Piece& piece = pieces_[count_++];
                                    piece.t_in = t_in;
                                    piece.t_out = t_out;
                                    piece.density = cell;
                                    piece.in_scattered = 0;
                                    depth += extinction_ * cell.mean * (t_out - t_in);
                                    goes_on_ = depth > deepest || count_ == capacity;
                                }
                                return !goes_on_;
                            });
}

float GuidedTracking::expected(const Piece& piece, float length) const {
    const float passed = std::exp(-extinction_ * piece.density.mean * length);
    return albedo_ * piece.in_scattered * (1 - passed) + passed * piece.behind;
}

void GuidedTracking::look_ahead(float ahead) {
    if (goes_on_) {
        // Where it is as dense behind, a flight finds what is scattered there.
        ahead = albedo_ * pieces_[count_ - 1].in_scattered;
    }
    for (int i = count_; i-- > 0;) {
        pieces_[i].behind = ahead;
        ahead = expected(pieces_[i], pieces_[i].t_out - pieces_[i].t_in);
    }
}

void GuidedTracking::level_out() {
    float depth = 0, lit = 0;
    for (int i = 0; i < count_; ++i) {
        const float before = depth;
        depth += extinction_ * pieces_[i].density.mean * (pieces_[i].t_out - pieces_[i].t_in);
        lit += pieces_[i].in_scattered * (std::exp(-before) - std::exp(-depth));
    }
    const float mean = depth > 0 ? lit / -std::expm1(-depth) : 0.0f;
    for (int i = 0; i < count_; ++i) {
        pieces_[i].in_scattered = mean;
    }
}

Flight GuidedTracking::fly(float ahead, bool level, Pcg32& random) {
    if (level) {
        level_out();
    }
    look_ahead(ahead);

    Flight flight;
    flight.distance = start_.length;
    flight.weight = Rgb(1.0f);
    flight.emitted = Rgb(0.0f);
    const Rgb& extinction = medium_.extinction();
    const float largest = max_value(extinction);
    if (!(largest > 0)) {
        return flight;
    }
    const Rgb relative = extinction / largest;
    const GridEmission* emission = medium_.emission();
    const auto index_ray = medium_.to_index(start_.ray);
    Rgb channels = channel_probabilities(start_.throughput);
    const bool grey = relative.r == relative.g && relative.g == relative.b;

    const float looks = medium_.looks(index_ray, start_.length);
    TentativeCollisions collisions(random);
    for (int i = 0; i < count_; ++i) {
        const Piece& piece = pieces_[i];
        const float length = piece.t_out - piece.t_in;
        if (is_too_dense(piece.density, extinction, length)) {
            if (fly_densely(medium_, start_, piece.t_in, piece.t_out, channels, flight, random)) {
                return flight;
            }
            continue;
        }
        const float foretold = expected(piece, length);
        const float bright = albedo_ * piece.in_scattered;
        // Collisions should come at this many times the rate of the medium; tentative ones come twice as often, so that
        // there is a choice.
        const float wanted = foretold > 0 ? bright / foretold : 1.0f;
        const float stretched = std::min(2 * std::max(wanted, bright > 0 ? 1.0f : 0.0f) * piece.density.mean,
                                         most_stretching * piece.density.maximum);
        const float rate = std::max(largest * std::max(piece.density.maximum, stretched), looks);
        for (double t_exact = piece.t_in; collisions.next(t_exact, piece.t_out, rate);) {
            const auto t = static_cast<float>(t_exact);
            const Vec3 corner(random.uniform(), random.uniform(), random.uniform());
            const float density = medium_.density().sample_nearest(index_ray.at(t), corner);
            if (emission) {
                const Vec3 place = start_.ray.at(t);
                pick_up(
                    flight,
                    flight.weight * medium_.absorption() * emission->at(place) * (start_.keeps(place) * density / rate),
                    t);
            }
            const float classical = largest * density * (grey ? 1.0f : dot(channels, relative)) / rate;
            const float here = classical * bright;
            const float on = (1 - classical) * expected(piece, piece.t_out - t);
            const float guided = here + on > 0 ? here / (here + on) : classical;
            const float real = defensive_fraction_ * classical + (1 - defensive_fraction_) * guided;
            if (random.uniform() < real) {
                flight.scatters = true;
                flight.distance = t;
                flight.weight *= medium_.scattering() * (density / (rate * real));
                flight.density_ratio *= real / classical;
                return flight;
            }
            flight.weight *= (Rgb(1.0f) - extinction * (density / rate)) * (1 / (1 - real));
            flight.density_ratio *= classical < 1 ? (1 - real) / (1 - classical) : 1.0f;
            if (!grey) {
                channels = channel_probabilities(start_.throughput * flight.weight);
            }
        }
    }
    if (goes_on_) {
        const float passed = reach();
        const FlightStart rest{Ray{start_.ray.at(passed), start_.ray.direction},
                               start_.length - passed,
                               start_.throughput * flight.weight,
                               start_.weight,
                               {},
                               start_.depth,
                               start_.keeps};
        const Flight last = ClassicalDistance().sample(medium_, rest, random);
        if (last.glow > 0) {
            pick_up(flight, flight.weight * last.emitted, passed + mean_value(last.emitted) / last.glow);
        }
        flight.weight *= last.weight;
        flight.scatters = last.scatters;
        flight.distance = last.scatters ? passed + last.distance : start_.length;
    }
    return flight;
}

}  // namespace wend
