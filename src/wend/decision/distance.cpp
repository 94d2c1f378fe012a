#include <wend/decision/distance.h>

#include <wend/decision/channels.h>
#include <wend/decision/dense_flight.h>
#include <wend/medium/medium.h>
#include <wend/medium/tentative_collisions.h>
#include <wend/medium/transmittance.h>

namespace wend {

void pick_up_along(Flight& flight, const HomogeneousMedium& medium, float length) {
    const Rgb emitted = emitted_along(medium, length);
    if (!is_black(emitted)) {
        // It comes from about a mean free path away, unless the segment is shorter.
        pick_up(flight, emitted, std::min(1 / mean_value(medium.extinction()), length / 2));
    }
}

float EmissionShare::operator()(const Vec3& position) const {
    if (!glow) {
        return 1;
    }
    const float other = connected * glow->seen_from(from, position, glow->density(position));
    return own > 0 ? own / (own + other) : 0.0f;
}

namespace {

Flight fly(const HomogeneousMedium& medium, float length, const Rgb& throughput, float u) {
    Flight flight;
    flight.distance = length;
    if (is_black(medium.scattering)) {
        pick_up_along(flight, medium, length);
        flight.weight = transmittance(medium, length);
        return flight;
    }
    const Rgb extinction = medium.extinction();
    const Rgb probability = channel_probabilities(throughput);
    const int channel = choose_channel(probability, u);
    if (extinction[channel] > 0) {
        const float t = to_exponential(u, extinction[channel]);
        if (t < length) {
            flight.scatters = true;
            flight.distance = t;
        }
    }
    pick_up_along(flight, medium, length);
    const Rgb transmitted = transmittance(medium, flight.distance);
    if (flight.scatters) {
        const float density = dot(probability, extinction * transmitted);
        flight.weight = density > 0 ? medium.scattering * transmitted * (1 / density) : Rgb(0.0f);
    } else {
        const float density = dot(probability, transmitted);
        flight.weight = density > 0 ? transmitted * (1 / density) : Rgb(0.0f);
    }
    return flight;
}

/// Goes on with a flight through a medium that collides, to its first real collision.
void track(const GridMedium& medium, const FlightStart& start, Flight& flight, Pcg32& random) {
    const Ray& ray = start.ray;
    const Rgb& extinction = medium.extinction();
    const float largest = max_value(extinction);
    const GridEmission* emission = medium.emission();
    const auto index_ray = medium.to_index(ray);
    const bool shines_apart = emission && emission->is_apart;
    const Rgb relative = extinction / largest;
    const bool grey = relative.r == relative.g && relative.g == relative.b;
    Rgb probability = channel_probabilities(start.throughput);

    // Tentative collisions at the majorant's rate for the channel of largest extinction: the transmittance of the
    // majorant is then the same in all channels and cancels. Which of them are real is decided for the mixture of
    // channels.
    const float looks = medium.looks(index_ray, start.length);
    TentativeCollisions collisions(random);
    const auto cross = [&](const MajorantGrid::Cell& cell, float t_in, float t_out) {
        if (!(cell.maximum > 0) && !shines_apart) {
            return true;
        }
        // What shines by itself does so between the voxels that a dense flight asks for.
        if (!shines_apart && is_too_dense(cell, extinction, t_out - t_in)) {
            return !fly_densely(medium, start, t_in, t_out, probability, flight, random);
        }
        const float rate = std::max(largest * cell.maximum, looks);
        const float majorant = rate / largest;
        for (double t_exact = t_in; collisions.next(t_exact, t_out, rate);) {
            const auto t = static_cast<float>(t_exact);
            const float u = random.uniform() * majorant;
            const float acceptance = grey ? 1.0f : dot(probability, relative);
            if (grey && !emission && u < cell.minimum) {
                // Certainly real: no need to look.
            } else {
                const Vec3 p = index_ray.at(t);
                const Vec3 corner(random.uniform(), random.uniform(), random.uniform());
                const float density = medium.density().sample_nearest(p, corner);
                if (emission) {
                    const Vec3 here = ray.at(t);
                    const Rgb absorbed = shines_apart ? Rgb(1.0f) : medium.absorption() * density;
                    pick_up(flight, flight.weight * absorbed * emission->at(here) * (start.keeps(here) / rate), t);
                }
                if (!(u < acceptance * density)) {
                    if (!grey) {
                        const float none = 1 / (majorant - acceptance * density);
                        flight.weight *= (Rgb(majorant) - relative * density) * none;
                        probability = channel_probabilities(start.throughput * flight.weight);
                    }
                    continue;
                }
            }
            flight.scatters = true;
            flight.distance = t;
            flight.weight *= medium.scattering() * (1 / (largest * acceptance));
            return false;
        }
        return true;
    };
    medium.majorants().walk(index_ray.origin, index_ray.direction, 0, start.length, cross);
}

/// The same where voxels have coefficients of their own, below a bound: which tentative collisions are real is decided
/// by the extinction of a voxel near them, for the mixture of channels.
void track_voxels(const GridMedium& medium, const FlightStart& start, Flight& flight, Pcg32& random) {
    const VoxelCoefficients& voxels = *medium.voxels();
    const GridEmission* emission = medium.emission();
    const bool shines_apart = emission && emission->is_apart;
    const auto index_ray = medium.to_index(start.ray);
    const float looks = medium.looks(index_ray, start.length);
    Rgb probability = channel_probabilities(start.throughput);
    TentativeCollisions collisions(random);
    const auto cross = [&](const MajorantGrid::Cell& cell, float t_in, float t_out) {
        if (!(cell.maximum > 0) && !shines_apart) {
            return true;
        }
        const float rate = std::max(cell.maximum, looks);
        for (double t_exact = t_in; collisions.next(t_exact, t_out, rate);) {
            const auto t = static_cast<float>(t_exact);
            const Vec3 p = index_ray.at(t);
            const Vec3 corner(random.uniform(), random.uniform(), random.uniform());
            const Rgb absorption = voxels.absorption.sample_nearest(p, corner);
            const Rgb scattering = voxels.scattering.sample_nearest(p, corner);
            if (emission) {
                const Vec3 here = start.ray.at(t);
                const Rgb absorbed = shines_apart ? Rgb(1.0f) : absorption;
                pick_up(flight, flight.weight * absorbed * emission->at(here) * (start.keeps(here) / rate), t);
            }
            const Rgb extinction = absorption + scattering;
            const float real = dot(probability, extinction);
            if (random.uniform() * rate < real) {
                flight.scatters = true;
                flight.distance = t;
                flight.weight *= scattering / real;
                return false;
            }
            flight.weight *= (Rgb(rate) - extinction) / (rate - real);
            probability = channel_probabilities(start.throughput * flight.weight);
        }
        return true;
    };
    medium.majorants().walk(index_ray.origin, index_ray.direction, 0, start.length, cross);
}

}  // namespace

Flight ClassicalDistance::sample(const GridMedium& medium, const FlightStart& start, Pcg32& random) const {
    Flight flight;
    flight.distance = start.length;
    flight.weight = Rgb(1.0f);
    flight.emitted = Rgb(0.0f);
    if (!(max_value(medium.extinction()) > 0)) {
        return flight;
    }
    if (is_black(medium.scattering()) && !medium.emission()) {
        flight.weight = estimate_transmittance(medium, start.ray, start.length, random);
        return flight;
    }
    medium.voxels() ? track_voxels(medium, start, flight, random) : track(medium, start, flight, random);
    return flight;
}

Flight ClassicalDistance::sample(const HomogeneousMedium& medium, const FlightStart& start, float u,
                                 Pcg32& /*random*/) const {
    return fly(medium, start.length, start.throughput, u);
}

Rgb ClassicalDistance::pass_probability(const HomogeneousMedium& medium, const Ray& /*ray*/, float length) const {
    return is_black(medium.scattering) ? Rgb(1.0f) : transmittance(medium, length);
}

}  // namespace wend
