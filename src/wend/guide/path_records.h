// What walks report to the guide: one record for each direction drawn and what came back along it.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/export.h>
#include <wend/core/vector.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

namespace wend::guide {

/// An estimate of the radiance arriving at a point from one direction. Estimates of zero are as informative as others:
/// they tell where walks go (the cells of the field follow that) and lower the mean.
struct Record {
    /// Where it arrives, in scene units.
    Vec3 position;
    /// Unit vector towards where the radiance comes from.
    Vec3 direction;
    /// Estimate of the incident radiance as a scalar, for instance its luminance; not negative.
    float radiance;
    /// Density the direction was drawn with, in 1/sr; positive.
    float density;
    /// Distance to the next vertex along the direction; positive, and infinite where there is none.
    float distance;
    /// The density that classical sampling had for the direction. This and the two that follow tell how classical and
    /// guided directions are best mixed; all 0 where there was no choice.
    float classical_density = 0;
    /// The density that the guide had for the direction.
    float guided_density = 0;
    /// The scattering function with its cosine times the radiance, a scalar too.
    float scattered = 0;
    /// The radiance by colour channel in any scale, of which only ratios count; not negative. Black stands for grey.
    Rgb colour{1.0f};
};

/// What a vertex of a walk says about the light that is scattered there: decisions about flights ask how much of it
/// there is ahead.
struct ScatterRecord {
    /// Of the vertex, in scene units.
    Vec3 position;
    /// Of the surface, on the side that the walk came from; zero in a volume.
    Vec3 normal;
    /// Estimate of the radiance that leaves to where the walk came from, as a scalar.
    float leaving;
    /// What a connection to a light found there: an estimate of the fluence of the light that connections account for,
    /// in radiance times sr.
    float connected;
    /// Towards the light, unit length; means nothing where `connected` is 0.
    Vec3 to_light;
    /// To the light; infinite for one that is far.
    float light_distance = std::numeric_limits<float>::infinity();
};

/// Records in an order that does not depend on threads, since sums of floating-point numbers depend on it: by pixel,
/// sample and vertex.
using Records = std::vector<Record>;

/// In the same order as Records.
using ScatterRecords = std::vector<ScatterRecord>;

/// Whether the field can learn from a record: finite numbers in their ranges (the distance may be infinite),
/// coordinates up to 1e15 and a weight up to 1e30.
WEND_API bool is_usable(const Record& record);
/// The same for what a vertex says about scattered light.
WEND_API bool is_usable(const ScatterRecord& record);

/// The record's share in ∫ L dω: radiance / density, in radiance times sr.
inline double weight_of(const Record& record) {
    return static_cast<double>(record.radiance) / record.density;
}

/// A place where a walk drew a direction. A walk that was split is a tree: several vertices name the same parent.
struct PathVertex {
    /// In place of a parent's index where there is none.
    static constexpr std::int32_t root = -1;

    /// In scene units.
    Vec3 position;
    /// Drawn here, unit length, towards where the walk went on.
    Vec3 direction;
    /// The direction was drawn with, in 1/sr; 0 for one of a discrete set (a mirror's), of which nothing is learned.
    float density = 0;
    /// What classical sampling has for the direction, where it was drawn from a mixture with a guide's; 0 otherwise.
    float classical_density = 0;
    /// What the guide has for the direction, likewise.
    float guided_density = 0;
    /// Along the direction to what the walk met first; infinity where there was nothing.
    float distance = std::numeric_limits<float>::infinity();
    /// Of the radiance gathered, the mean channel of what came from a medium before any vertex.
    float glow = 0;
    /// The same, each part over the distance that it came from.
    float glow_over_distance = 0;
    /// Weight that the walk gained on the way here since the parent's direction was drawn: transmittance over the
    /// density of the flight, 1 over the probability of surviving, 1 over the number of copies.
    Rgb arrival{1.0f};
    /// The scattering function, with its cosine, over the density of the direction.
    Rgb scattering;
    /// Radiance found after this direction and before the next one was drawn, per unit of the walk's weight once this
    /// direction was drawn: light met, the medium's own, and the next vertex's connection to a light, each with its
    /// weight of multiple importance sampling.
    Rgb gathered;
    /// What connections to lights brought at this vertex, the scattering function included. This and the three that
    /// follow are for records of scattered light alone: what arrives at the parent has it among what was gathered
    /// there.
    Rgb connected;
    /// Towards the light that outweighs the others, unit length; zero without a connection.
    Vec3 to_light{0, 0, 0};
    /// How far that light is.
    float light_distance = std::numeric_limits<float>::infinity();
    /// The connections' estimate of the fluence of lights, in radiance times sr.
    float light_fluence = 0;
    /// Of the surface, on the side that the walk came from; zero in a volume.
    Vec3 normal{0, 0, 0};
    /// The vertex whose direction led here: a lower index, or root.
    std::int32_t parent = root;
    /// Whether it is a collision in a medium: the field of volumes learns from it, otherwise that of surfaces.
    bool in_volume = false;
};

/// For every vertex an estimate of the radiance that arrives along its direction, by colour channel:
///     L_i = gathered_i + Σ_children arrival_j scattering_j L_j.
/// Returns the same sum over the roots, which is what the vertices' directions brought to where the walk began. Costs
/// O(vertices); `incident` is resized.
WEND_API Rgb incident_radiance(std::span<const PathVertex> path, std::vector<Rgb>& incident);

/// The distance that radiance arrived from along a vertex's direction: the harmonic mean of those of its parts.
inline float distance_of(const PathVertex& vertex, float arrived) {
    if (!(vertex.glow > 0)) {
        return vertex.distance;
    }
    const float others = std::max(0.0f, arrived - vertex.glow);
    return (vertex.glow + others) / (vertex.glow_over_distance + others / vertex.distance);
}

/// What a vertex tells, given the radiance that arrived: by channel, and as a scalar the mean of the channels. Nothing
/// is clamped: a record that is not finite stays as it is, for fit() to ignore and count.
inline Record record_of(const PathVertex& vertex, const Rgb& incident) {
    return {vertex.position,
            vertex.direction,
            mean(incident),
            vertex.density,
            distance_of(vertex, mean(incident)),
            vertex.classical_density,
            vertex.guided_density,
            mean(vertex.scattering * incident) * vertex.density,
            incident};
}

/// What the vertex tells of the light scattered there.
inline ScatterRecord scatter_record_of(const PathVertex& vertex, const Rgb& incident) {
    return {vertex.position,      vertex.normal,   mean(vertex.connected + vertex.scattering * incident),
            vertex.light_fluence, vertex.to_light, vertex.light_distance};
}

/// Records of many walks, kept apart by the field they belong to.
class WEND_API PathRecords {
public:
    /// Appends the records of a walk: one for each vertex whose direction has a density, with the mean of the colour
    /// channels as radiance, and one of the scattered light for every vertex. Of more than `most` vertices with a
    /// density every k-th is kept, with the least k that fits, and likewise of those without. Nothing is clamped: a
    /// record that is not finite stays as it is, for fit() to ignore and count. Without `scattered` there are none of
    /// the scattered light, which only guided flights ask for.
    void add(std::span<const PathVertex> path, std::size_t most = std::numeric_limits<std::size_t>::max(),
             bool scattered = true);

    /// The records of all producers, in the order given; each one's memory is free as soon as they are taken.
    static PathRecords joined(std::vector<PathRecords> parts);

    /// Of vertices, those without a density included.
    std::size_t size() const { return size_; }

    /// Forgets the records and keeps their memory.
    void clear() {
        surface_.clear();
        volume_.clear();
        surface_scattered_.clear();
        volume_scattered_.clear();
        size_ = 0;
    }

    /// For the field of surfaces: fit() takes them.
    const Records& surface() const { return surface_; }
    /// For the field of volumes.
    const Records& volume() const { return volume_; }
    /// Of every vertex on a surface that also has a record, and of those whose direction has no density: where asked
    /// for.
    const ScatterRecords& surface_scattered() const { return surface_scattered_; }
    /// Of every vertex in a volume, likewise.
    const ScatterRecords& volume_scattered() const { return volume_scattered_; }

    /// See ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& records) {
        bytes(records.surface_, records.volume_, records.surface_scattered_, records.volume_scattered_, records.size_);
    }

private:
    Records surface_, volume_;
    ScatterRecords surface_scattered_, volume_scattered_;
    std::size_t size_ = 0;
    std::vector<Rgb> incident_;
};

}  // namespace wend::guide
