// The techniques by which a path is drawn: one at a time, chosen where it enters a medium.
#pragma once

#include <wend/decision/direction.h>
#include <wend/subsurface/technique_mixes.h>
#include <wend/transport/interior_technique.h>
#include <wend/transport/vertex.h>

#include <variant>

namespace wend {

/// Where a path has nothing of its own: it follows the render's decisions.
struct FieldTechnique {
    static constexpr bool bounds_weights = false;

    template <class Decisions>
    auto directions(const Decisions& decisions, const VolumeScattering& f, const Vertex& v, float weight,
                    Pcg32& /*random*/) const {
        return decisions.direction.at(v.position, f, weight);
    }
};

/// In a dense medium, where this interior walk is left to classical sampling alone.
struct ClassicalTechnique {
    static constexpr bool bounds_weights = false;

    template <class Decisions>
    auto directions(const Decisions& /*decisions*/, const VolumeScattering& f, const Vertex& v, float /*weight*/,
                    Pcg32& /*random*/) const {
        return ClassicalDirection().at(v.position, f);
    }
};

/// A technique says how directions are drawn at a path's collisions: directions(decisions, f, vertex, weight, random),
/// and whether it bounds its own weights, so that decisions at surfaces need not see to that (`bounds_weights`). It may
/// do more, which the path tracer asks of each that can (InteriorTechnique can do all of it):
/// - enter(): learn that the path is at a boundary; turn() and head(): which direction it goes on in;
/// - draw_distance() and fly(): draw free flights;
/// - survival(): play roulette.
/// And its directions may have towards(), the interior walk on the way to a light, whose densities connections ask for,
/// and sample_emitters(), ways to lights that are connected to at the boundary ahead.
using PathTechnique = std::variant<FieldTechnique, ClassicalTechnique, InteriorTechnique>;

/// That of a path which enters a medium; `mix` is null where the medium is not dense.
inline PathTechnique technique_of(const TechniqueMix* mix, bool is_guided) {
    if (!mix) {
        return FieldTechnique();
    }
    if (is_guided) {
        return InteriorTechnique();
    }
    return mix->is_unguided_classical ? PathTechnique(ClassicalTechnique()) : FieldTechnique();
}

/// Of a path that is in a guided interior walk; else null.
inline const InteriorWalk* interior_of(const PathTechnique& technique) {
    const auto* interior = std::get_if<InteriorTechnique>(&technique);
    return interior ? &interior->walk() : nullptr;
}

}  // namespace wend
