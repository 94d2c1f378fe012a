#include <wend/light/beams.h>

#include <algorithm>
#include <cstddef>
#include <variant>

namespace wend {
namespace {

/// A light of this cone around the z axis of its own space.
template <class DirectedLight>
Beam beam_of(const DirectedLight& light, float cosine) {
    return {light.position, normalize(light.light_from_world.transposed_vector({0, 0, 1})), cosine,
            mean_value(light.intensity)};
}

}  // namespace

std::vector<Beam> beams_of(std::span<const Light> lights, float scene_radius) {
    // Wider ones are found by classical flights. Of many, each costs a test for every flight.
    constexpr float widest = 0.5f;
    constexpr std::size_t most = 16;
    std::vector<Beam> beams;
    std::vector<float> powers;
    float power = 0;
    for (const Light& light : lights) {
        const float own = light_power(light, scene_radius);
        power += own;
        if (beams.size() == most) {
            continue;
        }
        const auto* spot = std::get_if<SpotLight>(&light);
        const auto* projector = std::get_if<ProjectionLight>(&light);
        const float cosine = spot ? spot->cos_outer : projector ? corner_cosine(*projector) : 0.0f;
        if (cosine > widest) {
            beams.push_back(spot ? beam_of(*spot, cosine) : beam_of(*projector, cosine));
            powers.push_back(own);
        }
    }
    // All of it passes the scene's cross-section, and is scattered evenly.
    const float of_power = inv_4pi * inv_pi / sqr(std::max(scene_radius, 1e-15f));
    for (std::size_t i = 0; i < beams.size(); ++i) {
        beams[i].others = std::max(0.0f, power - powers[i]) * of_power;
    }
    return beams;
}

}  // namespace wend
