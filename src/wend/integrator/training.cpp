#include <wend/guide/fit.h>
#include <wend/integrator/training.h>

namespace wend {
namespace {

// More vertices of one walk say little that is new: they are correlated.
constexpr std::size_t most_vertices = 64;

float incident_radiance(const WalkVertex& vertex, const Rgb& gathered) {
    float sum = 0;
    for (int c = 0; c < 3; ++c) {
        const float later = gathered[c] - vertex.gathered[c];
        sum += vertex.throughput[c] > 0 && later > 0 ? later / vertex.throughput[c] : 0.0f;
    }
    return sum / 3;
}

}  // namespace

void TrainingRecords::add_walk(std::span<const WalkVertex> vertices, const Rgb& gathered) {
    std::size_t stride = 1;
    while (vertices.size() / stride > most_vertices) {
        stride *= 2;
    }
    for (std::size_t i = 0; i < vertices.size(); i += stride) {
        const WalkVertex& v = vertices[i];
        (v.in_volume ? volume : surface)
            .push_back({v.position, v.direction, incident_radiance(v, gathered), v.density, v.distance});
    }
}

GuidingFields learn(const GuidingFields& fields, std::span<const TrainingRecords> records, int threads) {
    guide::Records surface;
    guide::Records volume;
    for (const TrainingRecords& part : records) {
        surface.insert(surface.end(), part.surface.begin(), part.surface.end());
        volume.insert(volume.end(), part.volume.begin(), part.volume.end());
    }
    return {guide::fit(fields.surface, surface, {}, threads).field,
            guide::fit(fields.volume, volume, {}, threads).field};
}

}  // namespace wend
