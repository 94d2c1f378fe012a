// Decision 1: scatter in the medium, and where, or reach the end of the segment.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/export.h>
#include <wend/core/random.h>
#include <wend/medium/homogeneous.h>

#include <concepts>
#include <variant>

namespace wend {

/// The outcome of a flight through a medium.
struct Flight {
    bool scatters = false;  ///< whether it ends in a collision
    float distance = 0;     ///< of the collision; the segment's length if it does not scatter
    /// What the walk multiplies its throughput by: for a collision transmittance times scattering coefficient over
    /// density, for the end of the segment transmittance over probability.
    Rgb weight;
    Rgb emitted;              ///< radiance picked up from an emissive medium on the way, before `weight`
    float glow = 0;           ///< the mean channel of `emitted`, each part over the distance it came from
    float density_ratio = 1;  ///< density over what classical sampling would have had
};

/// Adds to a flight what the medium emits at a distance.
inline void pick_up(Flight& flight, const Rgb& emitted, float distance) {
    flight.emitted += emitted;
    if (distance > 0) {
        flight.glow += mean_value(emitted) / distance;
    }
}

/// Adds to a flight all that a homogeneous medium emits along its segment: the expected value, which has no variance.
WEND_API void pick_up_along(Flight& flight, const HomogeneousMedium& medium, float length);

/// What a walk knows about the end of a flight's segment when the flight is drawn, for decisions that ask what lies
/// ahead.
struct FlightEnd {
    /// What the segment ends at.
    enum class Kind { nothing, surface, interface };

    Kind kind = Kind::nothing;  ///< what it is
    Vec3 position{0, 0, 0};     ///< of the surface or interface
    Vec3 normal{0, 0, 0};       ///< of a surface, towards the segment
    /// Radiance of lights at the end, with their weights of multiple importance sampling, as a scalar.
    float emitted = 0;
};

class EmissionSampler;

/// What of a glowing medium's light a flight may keep, by multiple importance sampling: connections from the vertex
/// before find it as well.
struct WEND_API EmissionShare {
    const EmissionSampler* glow = nullptr;  ///< null: it keeps all
    Vec3 from{0, 0, 0};                     ///< the vertex
    float own = 0;                          ///< density of the flight's direction there, per steradian
    float connected = 0;                    ///< how often the vertex is connected to the medium

    /// At a point of the flight.
    float operator()(const Vec3& position) const;
};

/// What is known before a flight.
struct FlightStart {
    Ray ray;           ///< from where the flight begins
    float length = 0;  ///< to the end of the segment; may be beyond any scene
    /// Of the walk so far: chooses among colour channels.
    Rgb throughput{1.0f};
    /// Of the walk so far (ExpectedContribution::weight); 0 where the share of classical flights does not depend on it.
    float weight = 0;
    FlightEnd end;          ///< as far as is known
    EmissionShare keeps{};  ///< of the light of a medium that glows
};

/// A decision about flights: draws one, and tells the probability, under each colour channel, of flying through a
/// segment without a collision. Where that cannot be told (null-collision tracking) it is 1: it only enters multiple
/// importance sampling weights, where any function of the path will do.
template <class D>
concept DistanceDecision = requires(const D& d, const HomogeneousMedium& m, const FlightStart& start, float u,
                                    Pcg32& random) {
    { d.sample(m, start, u, random) } -> std::same_as<Flight>;
    { d.pass_probability(m, start.ray, start.length) } -> std::same_as<Rgb>;
    /// Whether FlightStart::end matters for a flight from there.
    { d.looks_ahead(m, start) } -> std::same_as<bool>;
};

/// Classical sampling: in proportion to transmittance times extinction, absorption by weight. Homogeneous media by
/// inversion; grids by delta tracking against the local majorant. Media that do not scatter are passed with their
/// transmittance as weight, which is exact: no walk goes on from a collision there. Only in grids that glow are flights
/// tracked all the same.
class WEND_API ClassicalDistance {
public:
    /// Never.
    template <class AnyMedium>
    bool looks_ahead(const AnyMedium& /*medium*/, const FlightStart& /*start*/) const {
        return false;
    }

    /// `u` is uniform in [0,1).
    Flight sample(const HomogeneousMedium& medium, const FlightStart& start, float u, Pcg32& random) const;
    /// By delta tracking.
    Flight sample(const GridMedium& medium, const FlightStart& start, Pcg32& random) const;
    /// Of either kind (medium.h).
    template <std::same_as<Medium> AnyMedium>
    Flight sample(const AnyMedium& medium, const FlightStart& start, float u, Pcg32& random) const {
        if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium)) {
            return sample(*homogeneous, start, u, random);
        }
        return sample(std::get<GridMedium>(medium), start, random);
    }
    /// The same by the next numbers of a generator alone.
    template <class AnyMedium>
    Flight sample(const AnyMedium& medium, const FlightStart& start, Pcg32& random) const {
        const float u = random.uniform();
        return sample(medium, start, u, random);
    }

    /// The transmittance.
    Rgb pass_probability(const HomogeneousMedium& medium, const Ray& ray, float length) const;
    /// Of either kind; 1 for a grid, where it is not known.
    template <std::same_as<Medium> AnyMedium>
    Rgb pass_probability(const AnyMedium& medium, const Ray& ray, float length) const {
        const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium);
        return homogeneous ? pass_probability(*homogeneous, ray, length) : Rgb(1.0f);
    }
};

static_assert(DistanceDecision<ClassicalDistance>);

}  // namespace wend
