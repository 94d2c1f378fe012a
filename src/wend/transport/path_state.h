// Where a walk is.
#pragma once

#include <wend/core/ray.h>
#include <wend/light/emitter_hit.h>
#include <wend/scene/traced_ray.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/subsurface/technique_mix.h>

namespace wend {

/// All that a walk needs to go on from its last vertex. A walk that was split has several. `RecorderBranch`: what its
/// recorders need for that.
template <class RecorderBranch>
struct PathState {
    TracedRay ray{};
    MediumState medium;
    Rgb throughput{1.0f};
    float density_ratio = 1;  ///< see WalkState
    float index_scale = 1;    ///< see WalkState
    float copies = 1;         ///< of the walk, as a mean: the product of all splits on the way here
    int depth = 0;            ///< vertices so far
    int uncounted = 0;        ///< of those, the ones that do not count towards the largest depth
    int interfaces = 0;
    float travelled = 0;  ///< since the last vertex
    LastVertex last;

    // The interior walk in a dense medium.
    InteriorWalk interior;           ///< if it is guided
    bool is_classical = false;       ///< in an interior walk left to classical sampling alone
    NextEventSettings next_event{};  ///< of vertices in the medium and on what it meets

    // Connections at the boundary of a dense medium that began at the last collision.
    /// The density of such a connection's direction, over that of the direction that was drawn.
    float emitters_ahead = 0;
    /// How often the surface vertex at hand was connected from the collision before, as a mean.
    float connected_before = 0;

    RecorderBranch recorded{};  ///< where the walk was split

    // The last medium that was entered where the boundary has a colour.
    MediumId coloured = vacuum;
    Rgb relative_albedo{1.0f};  ///< in it, over that of the medium
};

}  // namespace wend
