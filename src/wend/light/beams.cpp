#include <wend/light/beams.h>

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

std::vector<Beam> beams_of(std::span<const Light> lights) {
    // Wider ones are found by classical flights. Of many, each costs a test for every flight.
    constexpr float widest = 0.5f;
    constexpr std::size_t most = 16;
    std::vector<Beam> beams;
    for (const Light& light : lights) {
        if (beams.size() == most) {
            break;
        }
        if (const auto* spot = std::get_if<SpotLight>(&light); spot && spot->cos_outer > widest) {
            beams.push_back(beam_of(*spot, spot->cos_outer));
        }
        const auto* projector = std::get_if<ProjectionLight>(&light);
        if (projector && corner_cosine(*projector) > widest) {
            beams.push_back(beam_of(*projector, corner_cosine(*projector)));
        }
    }
    return beams;
}

}  // namespace wend
