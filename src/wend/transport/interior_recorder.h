// Records of walks inside dense media, for the technique mix.
#pragma once

#include <wend/subsurface/technique_mixes.h>
#include <wend/transport/walk_events.h>

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
        int walk = -1;                           ///< the last one; negative if there is none
        InteriorGuide::PerTechnique relative{};  ///< relative densities in it, or at its end
        InteriorGuide::PerTechnique
            at_collision{};        ///< and at the collision that connections at the boundary began from
        float from_collision = 0;  ///< part of the last vertex's connections that began there
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
        const InteriorWalk* const interior = walks_ ? interior_of(event.technique) : nullptr;
        now_.at_collision = interior ? interior->relative_densities() : InteriorGuide::PerTechnique{};
    }
    void on(const walk_events::Paused& event) { update(event.technique); }

private:
    InteriorWalkRecord* last() { return now_.walk >= 0 ? &(*walks_)[static_cast<std::size_t>(now_.walk)] : nullptr; }
    InteriorWalkRecord* last_in(MediumId medium) {
        InteriorWalkRecord* const walk = last();
        return walk && walk->medium == medium ? walk : nullptr;
    }
    /// Brings what is known of the last one up to date.
    void update(const PathTechnique& technique);
    /// How light that was found like this changes with the technique mix.
    MixGradient gradient_of(const walk_events::LightFound& found, const PathTechnique& technique) const;

    std::vector<InteriorWalkRecord>* walks_ = nullptr;
    Branch now_;
};

}  // namespace wend
