// Guided walks inside dense homogeneous media: for which media, and by which strategies.
#pragma once

#include <wend/decision/slab_walk.h>
#include <wend/integrator/boundary_field.h>
#include <wend/integrator/stay_plans.h>
#include <wend/scene/scene.h>

#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace wend {

/// Which outward normal a walk inside a dense medium takes the boundary to have.
enum class SlabStrategy {
    entry,     ///< that where it entered (krivanek2014)
    closest,   ///< that of the boundary closest to each collision (meng2016)
    incident,  ///< towards the light that diffuses in from outside (after meng2016)
    learned,   ///< as incident, and to the lamps that are seen from the closest boundary (after gouder2025)
    planar,    ///< that of the closest boundary, and the whole solution of the layer between it and the one behind
};

/// A value of --subsurface.
struct SubsurfacePreset {
    std::vector<SlabStrategy> strategies;  ///< beside classical sampling

    bool is_classical() const { return strategies.empty(); }
    friend bool operator==(const SubsurfacePreset&, const SubsurfacePreset&) = default;
};

/// Parses a value of --subsurface. Throws InputError, listing the names that there are, for any other.
SubsurfacePreset parse_subsurface(std::string_view text);

/// The canonical name.
std::string to_string(const SubsurfacePreset& preset);

/// The names, separated by commas.
std::string subsurface_names();

/// What is known of each dense medium of a scene. A medium is dense if it is homogeneous, scatters, does not glow, and
/// light that enters collides several times on a straight way through.
class SubsurfaceGuides {
public:
    /// No medium is guided.
    SubsurfaceGuides() = default;
    /// The scene must outlive it.
    SubsurfaceGuides(const Scene& scene, const SubsurfacePreset& preset, int threads);

    bool is_empty() const { return media_.empty(); }

    /// How stays that begin here are sampled; null for a medium that is not dense.
    const StayPlan* plan(MediumId medium, const Vec3& entry) const;

    /// Begins the walk's guided stay in a dense medium behind the surface that was hit, in the given direction, or lets
    /// one in the same medium go on. `channels` are the probabilities of the walk's colour channels.
    void enter(MediumId medium, const Hit& hit, const Vec3& direction, const Rgb& channels, SlabWalk& walk) const;

    /// Aims the strategies that look around at every collision.
    void aim(MediumId medium, const Vec3& position, SlabWalk& walk) const;

    /// What stays brought, counted apart by each thread.
    void count(const Stay& stay, StayMoments& moments) const;
    /// Learns plans for the stays to come.
    void learn(const StayMoments& moments, NextStays next);

private:
    struct Dense {
        SlabGuide guide;
        StayPlans plans;
        std::optional<BoundaryField> field;  ///< where a strategy asks it
        Rgb decay;                           ///< of diffuse light, per scene unit
        Rgb returned;                        ///< of an irradiance, the radiance that comes back
    };

    std::vector<SlabStrategy> strategies_;
    std::vector<std::unique_ptr<Dense>> media_;  // by medium; null: not guided
};

}  // namespace wend
