// From a walk to what the guide learns of it: the radiance that arrived at every vertex, in one sweep from the end.
#pragma once

#include <wend/core/colour.h>
#include <wend/guide/records.h>

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace wend::guide {

/// A place where a walk drew a direction. A walk that was split is a tree: several vertices name the same parent.
struct PathVertex {
    static constexpr std::int32_t root = -1;

    Vec3 position;
    /// Drawn here, unit length, towards where the walk went on.
    Vec3 direction;
    /// The direction was drawn with, in 1/sr; 0 for one of a discrete set (a mirror's), of which nothing is learned.
    float density = 0;
    /// Of the direction, by classical sampling and by the guide where it was drawn from a mixture of both; 0 otherwise.
    float classical_density = 0;
    float guided_density = 0;
    /// Along the direction to what the walk met first; infinity where there was nothing.
    float distance = std::numeric_limits<float>::infinity();
    /// Weight that the walk gained on the way here since the parent's direction was drawn: transmittance over the
    /// density of the flight, 1 over the probability of surviving, 1 over the number of copies.
    Rgb arrival{1.0f};
    /// The scattering function, with its cosine, over the density of the direction.
    Rgb scattering;
    /// Radiance found after this direction and before the next one was drawn, per unit of the walk's weight once this
    /// direction was drawn: light met, the medium's own, and the next vertex's connection to a light, each with its
    /// weight of multiple importance sampling.
    Rgb gathered;
    /// The vertex whose direction led here: a lower index, or root.
    std::int32_t parent = root;
    bool in_volume = false;
};

/// For every vertex an estimate of the radiance that arrives along its direction, by colour channel:
///     L_i = gathered_i + Σ_children arrival_j scattering_j L_j.
/// Returns the same sum over the roots, which is what the vertices' directions brought to where the walk began. Costs
/// O(vertices); `incident` is resized.
Rgb incident_radiance(std::span<const PathVertex> path, std::vector<Rgb>& incident);

/// What a vertex tells, given the radiance that arrived: by channel, and as a scalar the mean of the channels. Nothing
/// is clamped: a record that is not finite stays as it is, for fit() to ignore and count.
inline Record record_of(const PathVertex& vertex, const Rgb& incident) {
    return {vertex.position,
            vertex.direction,
            mean(incident),
            vertex.density,
            vertex.distance,
            vertex.classical_density,
            vertex.guided_density,
            mean(vertex.scattering * incident) * vertex.density,
            incident};
}

/// Records of many walks, kept apart by the field they belong to.
class PathRecords {
public:
    /// Appends the records of a walk, one for each vertex whose direction has a density; a record's radiance is the
    /// mean of the colour channels. Of walks with more than `most` of them every k-th is kept, with the least k that
    /// fits. Nothing is clamped: a record that is not finite stays as it is, for fit() to ignore and count.
    void add(std::span<const PathVertex> path, std::size_t most = std::numeric_limits<std::size_t>::max());

    /// Appends the records of another producer.
    void append(const PathRecords& other);

    /// Forgets the records and keeps their memory.
    void clear() {
        surface_.clear();
        volume_.clear();
    }

    const Records& surface() const { return surface_; }
    const Records& volume() const { return volume_; }

private:
    Records surface_, volume_;
    std::vector<Rgb> incident_;
};

}  // namespace wend::guide
