#include <wend/decision/dense_flight.h>

#include <wend/decision/channels.h>
#include <wend/medium/transmittance.h>
#include <wend/sampling/warp.h>

#include <cmath>

namespace wend {
namespace {

/// A depth below `most`, drawn as collisions of the chosen channel are that happen there, and its density by all.
struct DepthSample {
    double depth, density;
};

DepthSample sample_depth(const Rgb& extinction, const Rgb& probability, double most, Pcg32& random) {
    const auto collides = [&](int c) { return -std::expm1(-double{extinction[c]} * most); };
    float u = random.uniform();
    const double chosen = double{extinction[choose_channel(probability, u)]};
    DepthSample sample{chosen > 0 ? std::min(-std::log1p(u * std::expm1(-chosen * most)) / chosen, most) : u * most, 0};
    for (int c = 0; c < 3; ++c) {
        const double e = double{extinction[c]};
        sample.density +=
            double{probability[c]} * (collides(c) > 0 ? e * std::exp(-e * sample.depth) / collides(c) : 1 / most);
    }
    return sample;
}

}  // namespace

bool fly_densely(const GridMedium& medium, const FlightStart& start, float t_in, float t_out, Rgb& probability,
                 Flight& flight, Pcg32& random) {
    const Rgb& extinction = medium.extinction();
    const auto index_ray = medium.to_index(start.ray);
    float u = random.uniform();
    const double chosen = double{extinction[choose_channel(probability, u)]};
    const double free_depth = chosen > 0 ? double{sample_optical_depth(random)} / chosen : double{infinity};
    const Rgb before = flight.weight;
    double depth = 0;

    const auto pick_up_in = [&](const VoxelPassage& passage, double most) {
        const DepthSample at = sample_depth(extinction, probability, most, random);
        const auto t = static_cast<float>(passage.find(at.depth));
        const Vec3 here = start.ray.at(t);
        // The flight has come so far as one of the mixture of channels does.
        const double reached = double{dot(probability, transmitted(extinction, depth))};
        pick_up(flight,
                before * transmitted(extinction, depth + at.depth) * medium.absorption() * medium.emission()->at(here) *
                    static_cast<float>(start.keeps(here) / (reached * at.density)),
                t);
    };
    const auto cross = [&](const VoxelPassage& passage) {
        const double most = passage.depth();
        if (medium.emission() && most > 0) {
            pick_up_in(passage, most);
        }
        if (free_depth - depth < most) {
            flight.scatters = true;
            flight.distance = static_cast<float>(passage.find(free_depth - depth));
            depth = free_depth;
            return false;
        }
        depth += most;
        return true;
    };
    walk_voxels(medium.density(), index_ray.origin, index_ray.direction, t_in, t_out, cross);

    const Rgb passed = transmitted(extinction, depth);
    const float density = dot(probability, flight.scatters ? extinction * passed : passed);
    flight.weight *= (flight.scatters ? medium.scattering() * passed : passed) * (density > 0 ? 1 / density : 0.0f);
    probability = channel_probabilities(start.throughput * flight.weight);
    return flight.scatters;
}

}  // namespace wend
