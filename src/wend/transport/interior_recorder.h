// Records of walks inside dense media, for the technique mix.
#pragma once

#include <wend/light/emitter_hit.h>
#include <wend/transport/walk_events.h>

#include <optional>
#include <vector>

namespace wend {

/// Keeps what each interior walk found, and how that hangs on the technique mix.
class InteriorRecorder {
public:
    /// Records nothing.
    InteriorRecorder() = default;
    /// Interior walks are added.
    explicit InteriorRecorder(std::vector<InteriorWalkRecord>* walks) : walks_(walks) {}

    struct Branch {
        int walk = -1;                         ///< the last one; negative if there is none
        InteriorGuide::PerTechnique relative{};      ///< relative densities in it, or at its end
        InteriorGuide::PerTechnique at_collision{};  ///< and at the collision that connections at the boundary began from
        float from_collision = 0;              ///< part of the last vertex's connections that began there
    };
    Branch branch() const { return now_; }
    void resume(const Branch& branch) { now_ = branch; }
    void start() {}
    void finish() {}

    void on(const walk_events::Contributed& event);
    void on(const walk_events::EnteredMedium& event);
    void on(const walk_events::Flew& event) {
        if (InteriorWalkRecord* const walk = last_in(event.medium)) {
            ++walk->flights;
        }
    }
    void on(const walk_events::SawLight& event) {
        if (InteriorWalkRecord* const walk = last_in(event.medium)) {
            (event.through_boundaries ? walk->connected_through : walk->connected) = true;
        }
    }
    void on(const walk_events::ConnectedBefore& event) { now_.from_collision = event.part; }
    void on(const walk_events::Turning& event) {
        now_.at_collision =
            walks_ && event.interior.is_inside() ? event.interior.relative_densities() : InteriorGuide::PerTechnique{};
    }
    void on(const walk_events::Paused& event) { update(event.interior); }

    /// How what a connection brings changes with the technique mix: from a collision, where `weight` is the part of
    /// connections in its density; from the boundary, `before` being the part that began at the collision; and of light
    /// that a walk ran into. Nothing where nobody wants to know.
    std::optional<MixGradient> gradient_inside(const InteriorWalk& here, const InteriorWalk& there, float weight) const;
    std::optional<MixGradient> gradient_at_boundary(const InteriorWalk& here, float before) const;
    std::optional<MixGradient> gradient_of(const EmitterHit& arriving, const LastVertex& last,
                                           const InteriorWalk& interior);

private:
    InteriorWalkRecord* last() { return now_.walk >= 0 ? &(*walks_)[static_cast<std::size_t>(now_.walk)] : nullptr; }
    InteriorWalkRecord* last_in(MediumId medium) {
        InteriorWalkRecord* const walk = last();
        return walk && walk->medium == medium ? walk : nullptr;
    }
    /// Brings what is known of the last one up to date.
    void update(const InteriorWalk& interior);

    std::vector<InteriorWalkRecord>* walks_ = nullptr;
    Branch now_;
};

}  // namespace wend
