// Decision 1, guided: scatter or reach the end, and where, in proportion to the light that comes from there.
#pragma once

#include <wend/decision/distance.h>
#include <wend/decision/flight_pieces.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/medium/homogeneous.h>

#include <algorithm>
#include <concepts>
#include <span>
#include <type_traits>
#include <utility>
#include <variant>

namespace wend {

/// Adjoints along rays: cells with the light that is scattered in them (guide::Field).
template <class F>
concept AdjointAlongRays = requires(const F& field, const Vec3& p, const Ray& ray, const PhaseFunction& phase) {
    { field.is_trained() } -> std::same_as<bool>;
    { field.scattered_light(p)->in_scattered(p, phase) } -> std::same_as<float>;
    { field.scattered_light(p)->in_scattered_from_afar(p, phase) } -> std::same_as<float>;
    { field.scattered_light(p)->near.intensity } -> std::convertible_to<float>;
    { field.leaving(p, p) } -> std::same_as<float>;
    { field.scattered_light(p)->confidence } -> std::convertible_to<float>;
    field.walk(
        ray, 0.0f, 1.0f, [](const auto& light, float, float) { return light.confidence > 0; }, 0.1f);
    { field.find(p)->incident(p).density(p) } -> std::same_as<float>;
};

/// Which part of the decision follows the light.
enum class DistanceGuiding { scatter_alone, scatter_and_distance };

/// Flights through homogeneous media in proportion to the light along the ray as the cells of the volume's field tell
/// it (FlightPieces), and to that of the beams that it crosses; where the field knows nothing yet, to that alone.
/// Through grids they are classical (docs/experiments/distance.md).
template <AdjointAlongRays Field>
class GuidedDistance {
public:
    /// Neither the fields nor the beams are owned. `defensive_fraction` in (0,1] bounds the weight by
    /// 1/defensive_fraction times the classical one.
    GuidedDistance(const Field* surface, const Field* volume, float defensive_fraction, DistanceGuiding guiding,
                   std::span<const Beam> beams = {})
        : surface_(surface),
          volume_(volume),
          defensive_fraction_(defensive_fraction),
          guiding_(guiding),
          beams_(beams) {}

    /// Of a pair of fields (guide::Fields), which must stay where they are; others may be assigned to them.
    template <class Fields>
    requires std::same_as<std::remove_cvref_t<decltype(std::declval<Fields>().surface)>, Field>
    explicit GuidedDistance(const Fields& fields, float defensive_fraction = 0.3f,
                            DistanceGuiding guiding = DistanceGuiding::scatter_and_distance)
        : GuidedDistance(&fields.surface, &fields.volume, defensive_fraction, guiding) {}

    /// Whether a flight is guided as soon as something is known: not that of a walk which is as heavy as may be.
    static bool can_be_guided(const HomogeneousMedium& medium, const FlightStart& start) {
        return !is_black(medium.scattering) && start.weight < weight_bound && start.length > 0;
    }
    /// Whether the flight's end counts for it: nothing is known of that before something is learned.
    bool looks_ahead(const HomogeneousMedium& medium, const FlightStart& start) const {
        return volume_->is_trained() && can_be_guided(medium, start);
    }
    /// Of either kind (medium.h).
    template <std::same_as<Medium> AnyMedium>
    bool looks_ahead(const AnyMedium& medium, const FlightStart& start) const {
        const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium);
        return homogeneous && looks_ahead(*homogeneous, start);
    }

    /// A flight, from `u` in [0,1); classical ones may want more random numbers.
    Flight sample(const HomogeneousMedium& medium, const FlightStart& start, float u, Pcg32& random) const {
        if (can_be_guided(medium, start) && (volume_->is_trained() || crosses_beam(start))) {
            return fly(medium, start, u);
        }
        return classical_.sample(medium, start, u, random);
    }
    /// Of either kind (medium.h).
    template <std::same_as<Medium> AnyMedium>
    Flight sample(const AnyMedium& medium, const FlightStart& start, float u, Pcg32& random) const {
        if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium)) {
            return sample(*homogeneous, start, u, random);
        }
        return classical_.sample(std::get<GridMedium>(medium), start, random);
    }
    /// The same by the next numbers of a generator alone.
    template <class AnyMedium>
    Flight sample(const AnyMedium& medium, const FlightStart& start, Pcg32& random) const {
        const float u = random.uniform();
        return sample(medium, start, u, random);
    }

    /// That of classical flights: a guided one's would take a walk through all cells for every connection.
    template <class AnyMedium>
    Rgb pass_probability(const AnyMedium& medium, const Ray& ray, float length) const {
        return classical_.pass_probability(medium, ray, length);
    }

private:
    /// How far beams are to be trusted, wherever the flight begins: something may stand in them.
    static constexpr float trust_in_beams = 2.0f / 3;
    /// So close to a lamp, in lengths of a flight, it begins at the lamp.
    static constexpr float closest = 1e-4f;
    /// Of a flight, what cells on its way are told apart to.
    static constexpr float finest = 1.0f / 20;

    /// What the guide is not trusted with is added to the classical flights.
    float defensive_fraction(float confidence, float weight) const {
        return std::max(1 - (1 - defensive_fraction_) * confidence, least_defensive_fraction(weight));
    }

    Flight fly(const HomogeneousMedium& medium, const FlightStart& start, float u) const {
        FlightPieces pieces(medium.extinction(), medium.scattering, channel_probabilities(start.throughput));
        float confidence = 0, share = 0;
        const bool is_trained = volume_->is_trained();
        const float reach = 8 / mean_value(medium.extinction());
        // The kind of phase function is asked for once, not in every cell.
        medium.phase.visit([&](const auto& phase) {
            share = look_for_beams(start, phase, 1 / mean_value(medium.extinction()), pieces);
            confidence = is_trained ? look_along(start, phase, reach, pieces) : look_nowhere(start, pieces);
        });
        confidence = std::max(confidence, share * trust_in_beams);
        pieces.finish(start.length, is_trained ? ahead(start) : 0.0f, is_trained && levels());
        const FlightPieces::Outcome outcome =
            pieces.sample(pieces.is_lit() ? defensive_fraction(confidence, start.weight) : 1.0f, u);
        Flight flight;
        flight.scatters = outcome.scatters;
        flight.distance = outcome.distance;
        flight.density_ratio = outcome.classical > 0 ? outcome.density / outcome.classical : 1.0f;
        const Rgb transmitted = transmittance(medium, flight.distance);
        flight.weight = (flight.scatters ? medium.scattering * transmitted : transmitted) *
                        (outcome.density > 0 ? 1 / outcome.density : 0.0f);
        pick_up_along(flight, medium, start.length);
        return flight;
    }

    bool crosses_beam(const FlightStart& start) const {
        return std::any_of(beams_.begin(), beams_.end(),
                           [&](const Beam& beam) { return crossing(beam, start.ray, start.length).has_value(); });
    }

    /// Of the light that a flight may meet, how much is that of a beam it crosses: the largest such share, 0 where
    /// there is none.
    template <class Phase>
    float look_for_beams(const FlightStart& start, const Phase& phase, float mean_free_path,
                         FlightPieces& pieces) const {
        // A segment may be longer than any scene.
        const float way = std::min(start.length, mean_free_path), at_lamp = closest * way;
        float share = 0;
        for (const Beam& beam : beams_) {
            const auto part = pieces.has_room_for_beam() ? crossing(beam, start.ray, start.length) : std::nullopt;
            // Away from the lamp itself its light grows without end.
            const bool starts_at_lamp = length_squared(start.ray.origin - beam.position) < sqr(at_lamp);
            if (part && !starts_at_lamp) {
                const Equiangular along(ClosestApproach(start.ray, beam.position, 0), part->t_in, part->t_out);
                const float strength = beam.intensity * phase.evaluate(along.cosine());
                pieces.add_beam(along, strength);
                const float lit = strength * along.integral();
                share = std::max(share, lit > 0 ? lit / (lit + beam.others * way) : 0.0f);
            }
        }
        return share;
    }

    /// How far the cell at the beginning is to be trusted. `reach`: few flights go further.
    template <class Phase>
    float look_along(const FlightStart& start, const Phase& phase, float reach, FlightPieces& pieces) const {
        const Vec3& before = start.ray.direction;
        float confidence = 0;
        const auto look = [&](const auto& light, float t_in, float t_out) {
            if (!(t_in > 0)) {
                confidence = light.confidence;
            }
            if (light.near.intensity > 0) {
                const ClosestApproach approach(start.ray, light.near.position, light.near.extent_squared);
                const float afar = light.in_scattered_from_afar(before, phase);
                if (approach.is_about_as_far(t_in, t_out)) {
                    const float fluence = light.near.intensity * approach.mean_inverse_square(t_in, t_out);
                    const float cosine = approach.cosine(0.5f * (t_in + t_out));
                    return pieces.add(t_out, afar + fluence * phase.evaluate(cosine));
                }
                if (pieces.has_room_for_near()) {
                    const Equiangular along(approach, t_in, t_out);
                    pieces.add_near(along, light.near.intensity * phase.evaluate(along.cosine()));
                    return pieces.add(t_out, afar);
                }
            }
            return pieces.add(t_out, light.in_scattered(before, phase));
        };
        volume_->walk(start.ray, 0, start.length, look, finest * std::min(start.length, reach));
        return confidence;
    }

    /// One dark piece, and no trust in it.
    static float look_nowhere(const FlightStart& start, FlightPieces& pieces) {
        pieces.add(start.length, 0);
        return 0;
    }

    bool levels() const { return guiding_ == DistanceGuiding::scatter_alone; }

    /// The radiance to be expected behind the end of the segment.
    float ahead(const FlightStart& start) const {
        const FlightEnd& end = start.end;
        if (end.kind == FlightEnd::Kind::surface) {
            return end.emitted + surface_->leaving(end.position, end.normal);
        }
        if (end.kind == FlightEnd::Kind::interface) {
            const auto* adjoint = volume_->find(end.position);
            return end.emitted + adjoint->fluence() * adjoint->incident(end.position).density(start.ray.direction);
        }
        return end.emitted;
    }

    const Field* surface_;
    const Field* volume_;
    float defensive_fraction_;
    DistanceGuiding guiding_;
    std::span<const Beam> beams_;
    ClassicalDistance classical_;
};

/// Of a pair of fields, such as guide::Fields.
template <class Fields>
GuidedDistance(const Fields& fields) -> GuidedDistance<std::remove_cvref_t<decltype(fields.surface)>>;

}  // namespace wend
