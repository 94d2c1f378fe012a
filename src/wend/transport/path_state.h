// Where a path is.
#pragma once

#include <wend/core/colour.h>
#include <wend/light/emitter_hit.h>
#include <wend/scene/scene.h>
#include <wend/scene/traced_ray.h>
#include <wend/subsurface/technique_mixes.h>
#include <wend/transport/path_technique.h>

#include <algorithm>
#include <cstdint>
#include <variant>

namespace wend {

/// What the path carries.
struct PathWeight {
    Rgb throughput{1.0f};
    float density_ratio = 1;  ///< see WalkState
    float index_scale = 1;    ///< see WalkState
    float copies = 1;         ///< of the walk, as a mean: the product of all splits on the way here
    /// Probability of not having been ended by roulette, over what it would have been unguided.
    float survival_ratio = 1;
    float unguided = 0;  ///< what the path would have brought so far, had it gone this way unguided

    /// Density of having come here, over what it would have been unguided.
    float unguided_ratio() const { return density_ratio * survival_ratio; }
    /// ExpectedContribution::weight.
    float value() const { return mean_value(throughput) * index_scale; }
};

/// What the path has met so far.
struct PathCounts {
    int vertices = 0;
    int uncounted = 0;              ///< of those, the ones that do not count towards the largest depth
    std::int16_t interfaces = 0;    ///< up to most_interfaces
    bool begins_in_medium = false;  ///< whether the first vertex is in one

    /// How many vertices more, that count, are not too many.
    int vertices_left(int max_depth) const { return max_depth - (vertices - uncounted); }
};

/// The colour of a medium where it was entered.
struct MediumTint {
    MediumId medium = vacuum;   ///< the last one that was entered where the boundary has a colour
    Rgb relative_albedo{1.0f};  ///< in it, over that of the medium
};

/// What a path has of the interior walk that it is in, or that it has come out of.
struct PathInterior {
    PathTechnique technique;
    NextEventSettings next_event{};  ///< of collisions in the medium and of what is met from inside of it
    MediumTint tint;
    WayOut way;
};

/// All that a path needs to go on from its last vertex. One that was split has several.
struct PathState {
    TracedRay ray{};
    MediumState medium;
    PathWeight weight;
    PathCounts counts;
    float travelled = 0;  ///< since the last vertex
    LastVertex last;
    PathInterior interior;

    /// The ray from a vertex that the path has just come to, in a direction, and the medium that it is in.
    TracedRay leave(const Vertex& v, const Vec3& w) const {
        return v.in_volume() ? TracedRay(Ray{v.position, w, ray.time}) : ray.leave(*v.hit, w);
    }
    MediumState medium_towards(const Scene& scene, const Vertex& v, const Vec3& w) const {
        return v.in_volume() ? medium : scene.medium_beyond(*v.hit, w, medium);
    }

    /// By which guided decisions are the more classical the heavier the path is. Where the technique bounds its own
    /// weights they are not: at the boundary of an interior walk connections from the collision before have to know
    /// their densities, and not the roulette since. Copies of a path may grow as it might have, but only so many: each
    /// that has become heavy is split again, and all of them together would know no bound.
    float weight_to_bound() const {
        constexpr float free_copies = 8;
        const bool is_bounded = std::visit([](const auto& t) { return t.bounds_weights; }, interior.technique);
        return is_bounded ? 0.0f : weight.value() * std::max(1.0f, weight.copies / free_copies);
    }

    /// How often such a vertex is connected to lights that directions find as well, as a mean.
    float connections(const Vertex& v) const {
        return v.in_volume() ? interior.next_event.probability : static_cast<float>(interior.next_event.at_surfaces);
    }
    /// What multiplies the density of the path's own directions there where it is weighed against that of connections.
    float preference(const Vertex& v) const { return v.in_volume() ? interior.next_event.preference : 1.0f; }
};

// A path that is split keeps one of each branch.
static_assert(sizeof(PathState) - sizeof(PathInterior) <= 288);

}  // namespace wend
