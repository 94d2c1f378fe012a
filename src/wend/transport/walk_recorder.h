// What a walk says of itself to those that learn from walks.
#pragma once

#include <wend/guide/path_log.h>
#include <wend/light/caustic_photons.h>
#include <wend/light/emitter_hit.h>
#include <wend/light/light_selection.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/subsurface/interior_walk_record.h>
#include <wend/transport/reflection_probability.h>
#include <wend/transport/vertex.h>

#include <optional>
#include <vector>

namespace wend {

/// Where records of a walk go, all of them optional.
struct RecorderTargets {
    guide::PathLog* log = nullptr;                              ///< for directions; is started anew
    std::vector<InteriorWalkRecord>* interior_walks = nullptr;  ///< those in dense media are added
    std::vector<LightRecord>* lights = nullptr;                 ///< what connections brought is added
    std::vector<ReflectionRecord>* reflections = nullptr;       ///< what was found behind boundaries is added
    const CausticPhotons* caustics = nullptr;                   ///< what the log is told beside what walks find
};

/// The walk says once what happens to it, and need not know who records it. A walk that is recorded draws more
/// random numbers (choose_recording(), hint_at_caustics()); what it estimates is the same.
class WalkRecorder {
public:
    WalkRecorder(const RecorderTargets& to, const LightSelection& choices,
                 const ReflectionProbability& reflection_probability)
        : to_(to), choices_(choices), reflection_probability_(reflection_probability) {}

    void start();
    /// The walk has ended, with all its branches.
    void finish();

    /// Where a walk that is split goes on from.
    struct Branch {
        guide::PathLog::Branch path{};
        int boundary = ReflectionLog::none;    ///< the last one that was passed
        int interior_walk = -1;                ///< the last one; negative if there is none
        bool is_logged = true;                 ///< whether the log has collisions of this interior walk
        InteriorGuide::Shares relative{};      ///< relative densities in the interior walk, or at its end
        InteriorGuide::Shares at_collision{};  ///< and at the collision that connections at the boundary began from
        float from_collision = 0;              ///< part of the last vertex's connections that began there
    };
    Branch branch() const;
    void resume(const Branch& branch);

    // The walk's weight, and what it finds.
    void weigh(const Rgb& weight) {
        if (to_.log) {
            to_.log->weigh(weight);
        }
    }
    /// Light found on the way from the last vertex, without the walk's weight.
    void gather(const Rgb& radiance) {
        if (to_.log) {
            to_.log->gather(radiance);
        }
    }
    /// The same of a medium's own, from this mean distance.
    void glow(const Rgb& radiance, float distance) {
        if (to_.log) {
            to_.log->glow(radiance, distance);
        }
    }
    /// What any light found adds to the picture, the walk's weight included.
    void bring(float light, const std::optional<MixGradient>& slope, const InteriorWalk& interior);

    // Its vertices.
    void meet(float travelled) {
        if (to_.log) {
            to_.log->meet(travelled);
        }
    }
    void collide(const Medium& medium, const Vec3& position);
    void face(const Vertex& v) {
        if (to_.log) {
            to_.log->face(v.facing);
        }
    }
    /// The walk goes on in direction s, with this throughput; `part` of the vertex's connections began at the collision
    /// before.
    void scatter(const DirectionSample& s, const Vertex& v, const Rgb& throughput);
    void remember_connections(float part) { now_.from_collision = part; }
    /// A boundary was reflected at or refracted through; `worth`: the throughput had Fresnel's equations chosen.
    void reflect(const DirectionSample& s, const Vertex& v, float worth);

    // Next-event estimation.
    /// A connection to a light brought this, with the weight that `fluence` over the scattering function has; as many
    /// as `times` were made, as a mean.
    void connect(const Vertex& v, int light, float choice_probability, float times, const Vec3& to_light,
                 float distance, float fluence, const Rgb& brought);
    /// The boundary ahead of a collision was connected to lights in direction w, with this phase function.
    void connect_at_boundary(const Vec3& w, const Rgb& phase, const Rgb& brought);
    /// Whether hints at lights that no connection reaches are of use.
    bool takes_hints() const { return to_.log != nullptr; }
    void hint(const guide::Hint& hint) { to_.log->hint(hint); }
    void hint_at_caustics(const Vertex& v, const InteriorWalk& interior, Pcg32& random);

    // Walks inside dense media.
    /// Whether the log has what a walk meets inside: always if it is unguided.
    void choose_recording(bool guided, float probability, Pcg32& random);
    void enter(MediumId medium, const Vec3& position, bool guided);
    void fly(MediumId medium);
    void connected(MediumId medium, bool through_boundaries);
    /// Brings what is known of the interior walk up to date.
    void update(const InteriorWalk& interior);
    /// A direction is about to be drawn at a collision, or was looked into.
    void turn(const InteriorWalk& interior);

    /// How what a connection brings changes with the ways to sample an interior walk: from a collision, where `weight`
    /// is the part of connections in its density; from the boundary, `before` being the part that began at the
    /// collision; and of light that a walk ran into. Nothing where nobody wants to know.
    std::optional<MixGradient> slope_inside(const InteriorWalk& here, const InteriorWalk& there, float weight) const;
    std::optional<MixGradient> slope_at_boundary(const InteriorWalk& here, float before) const;
    std::optional<MixGradient> slope_of(const EmitterHit& arriving, const LastVertex& last,
                                        const InteriorWalk& interior);

private:
    InteriorWalkRecord* last_interior_walk() {
        return now_.interior_walk >= 0 ? &(*to_.interior_walks)[static_cast<std::size_t>(now_.interior_walk)] : nullptr;
    }
    InteriorWalkRecord* interior_walk_in(MediumId medium) {
        InteriorWalkRecord* const interior_walk = last_interior_walk();
        return interior_walk && interior_walk->medium == medium ? interior_walk : nullptr;
    }

    RecorderTargets to_;
    const LightSelection& choices_;
    const ReflectionProbability& reflection_probability_;
    ReflectionLog boundaries_;
    Branch now_;
};

}  // namespace wend
