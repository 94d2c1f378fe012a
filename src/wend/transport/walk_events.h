// What happens to a walk, as those learn of it who record walks.
#pragma once

#include <wend/core/random.h>
#include <wend/decision/direction.h>
#include <wend/light/emitter_hit.h>
#include <wend/transport/path_technique.h>
#include <wend/transport/vertex.h>

/// Each event is made where it happens and is over at once: it refers to what the walk has at hand.
namespace wend::walk_events {

/// The walk's weight was multiplied.
struct Weighed {
    const Rgb& weight;
};

// Light on the way from the last vertex, without the walk's weight.
struct MetLight {
    const Rgb& radiance;
};
/// A medium's own, from this mean distance.
struct MetEmission {
    const Rgb& radiance;
    float distance;
};
/// How light was found that counts otherwise, by multiple importance sampling, than the walk's density does.
struct LightFound {
    /// By a connection from a collision: the interior walk towards the light, and the part of connections in the
    /// density.
    const InteriorWalk* towards = nullptr;
    float by_connections = 0;
    /// By a connection at a surface, of which this part began at the collision before.
    float from_collision = 0;
    /// By running into it, after this vertex.
    const EmitterHit* hit = nullptr;
    const LastVertex* last = nullptr;
};
/// What any light adds to the image, the walk's weight included, as the mean of its channels.
struct Contributed {
    float light;
    const PathTechnique& technique;
    const LightFound& found;
};

/// The walk came to a vertex, so far from the last one.
struct Arrived {
    float travelled;
};
struct HitSurface {
    const Vertex& vertex;
};
/// The walk goes on in a direction, with this throughput.
struct Scattered {
    const DirectionSample& sample;
    const Vertex& vertex;
    const Rgb& throughput;
};
/// A boundary was reflected at or refracted through. `worth`: the throughput had Fresnel's equations chosen.
struct PassedBoundary {
    const DirectionSample& sample;
    const Vertex& vertex;
    float worth;
};

/// A connection to a light found this much, with the weight that `fluence` over the scattering function has; as many as
/// `times` were made, as a mean.
struct Connected {
    const Vertex& vertex;
    int light;
    float choice_probability, times;
    const Vec3& to_light;
    float distance, fluence;
    const Rgb& contribution;
};
/// The boundary ahead of a collision was connected to lights, in a direction with this value of the phase function.
struct ConnectedAhead {
    const Vec3& direction;
    const Rgb& phase;
    const Rgb& contribution;
};
/// A connection from a collision has succeeded.
struct SawLight {
    MediumId medium;
    bool through_boundaries;
};
/// This part of the last vertex's connections began at the collision before.
struct ConnectedBefore {
    float part;
};

/// A medium was entered. `dense`: as an interior walk, `guided` or not, of which the field is to hear with this
/// probability.
struct EnteredMedium {
    MediumId medium;
    const Vec3& position;
    bool dense, guided;
    float recording_probability;
    Pcg32& random;
};
struct Flew {
    MediumId medium;
};
/// A direction is about to be drawn at a collision, or was looked into.
struct Turning {
    const PathTechnique& technique;
};
/// The walk ends, or comes to a boundary.
struct Paused {
    const PathTechnique& technique;
};

}  // namespace wend::walk_events
