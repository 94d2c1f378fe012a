// Guided walks inside dense homogeneous media: for which media, and what is known of each.
#pragma once

#include <wend/scene/scene.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/subsurface/preset.h>
#include <wend/subsurface/technique_mixes.h>
#include <wend/transport/boundary_field.h>

#include <memory>
#include <optional>
#include <vector>

namespace wend {

/// What is known of each dense medium of a scene. A medium is dense if it is homogeneous, scatters, does not glow, and
/// light that enters collides several times on a straight way through.
class SubsurfaceGuides {
public:
    /// No medium is guided.
    SubsurfaceGuides() = default;
    /// The scene must outlive it.
    SubsurfaceGuides(const Scene& scene, const SubsurfacePreset& preset);

    /// Whether a scene has a medium to be guided: soon known, long before there are guides.
    static bool has_dense_medium(const Scene& scene);

    bool is_empty() const { return media_.empty(); }

    /// How interior walks that begin here are sampled; null for a medium that is not dense.
    const TechniqueMix* plan(MediumId medium, const Vec3& entry) const;

    /// Begins the walk's guided interior walk in a dense medium behind the surface that was hit, in the given
    /// direction, or lets one in the same medium go on. `channels` are the probabilities of the walk's colour channels.
    void enter(MediumId medium, const Hit& hit, const Vec3& direction, const Rgb& channels, InteriorWalk& walk) const;

    /// Aims a walk at a collision.
    void aim(MediumId medium, const Vec3& position, InteriorWalk& walk) const;

    /// What interior walks brought, counted apart by each thread.
    void count(const InteriorWalkRecord& interior_walk, SecondMoments& moments) const;
    /// Learns plans for the interior walks to come.
    void learn(const SecondMoments& moments, NextWalks next);

    /// What was learned of each medium, for guides of the same scene and preset; see ListsMembers.
    template <class Archive, class Self>
    static void archive(Archive& bytes, Self& guides) {
        for (auto& medium : guides.media_) {
            if (medium) {
                bytes(medium->plans);
            }
        }
    }

    /// Throws unless moments can be of interior walks in these media.
    template <class Archive>
    void check(Archive& bytes, const SecondMoments& moments) const {
        for (std::size_t id = 0; id < media_.size(); ++id) {
            for (const auto& [cell, sums] : moments.of(static_cast<int>(id))) {
                bytes.require(media_[id] && cell >= 0 && cell < media_[id]->plans.cells());
            }
        }
    }

private:
    struct Dense {
        InteriorGuide guide;
        TechniqueMixes plans;
        std::optional<BoundaryField> field;  ///< where the strategy asks it
        Rgb decay;                           ///< of diffuse light, per scene unit
        Rgb returned;                        ///< of an irradiance, the radiance that comes back
    };

    /// What there is to know of a dense medium behind these points of its boundary.
    std::unique_ptr<Dense> explore(const Scene& scene, MediumId id, const HomogeneousMedium& medium,
                                   const std::vector<BoundaryPoint>& points, Pcg32& random) const;

    std::optional<InteriorStrategy> strategy_;
    std::vector<std::unique_ptr<Dense>> media_;  // by medium; null: not guided
};

}  // namespace wend
