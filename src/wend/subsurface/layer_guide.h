// The exact adjoint of layers, for walks in dense media of any shape.
#pragma once

#include <wend/planar/modal_decisions.h>

#include <array>
#include <memory>
#include <vector>

namespace wend {

/// Where a walk is if the medium around it is taken for a layer between two planes, both lit evenly. Lengths in scene
/// units.
struct LayerPlace {
    Vec3 inward{0, 0, 1};  ///< from the closer boundary to the other
    float depth = 0;       ///< from the closer boundary
    float thickness = 0;   ///< may be infinite
    float near = 1;        ///< radiance that arrives at the closer boundary from outside
    float far = 0;         ///< at the other
};

/// Solutions for one channel of a medium, by thickness. The radiance is that of two layers, each lit from one side; of
/// a half-space, from the closer boundary alone. All that is asked is a probability whatever the true shape is: a
/// flight that would be outside of its layer goes on classically.
class LayerGuide {
public:
    LayerGuide() = default;
    /// `layers`: those of planar/lit_layers.h or the like, 1, 2, 4, ... mean free paths thick and last a half-space,
    /// for the same mean cosine, in [-0.95, 0.95]. Henyey and Greenstein's phase function is used in place of any
    /// other.
    LayerGuide(double extinction, double mean_cosine, std::vector<PlanarAdjoint> layers);

    /// What a walk may expect that goes on along w.
    double radiance(const LayerPlace& place, const Vec3& w) const { return radiance(place, w, 0); }

    /// A distance along w, with a density in proportion to transmittance times in-scattered radiance; a classical one
    /// where the radiance is none.
    double sample_distance(const LayerPlace& place, const Vec3& w, Pcg32& random) const;
    /// The probability of a flight longer than t, or the density per scene unit of a flight that `collides` at t, given
    /// that radiance(place, w) is `expected`.
    double flight(const LayerPlace& place, const Vec3& w, double expected, double t, bool collides) const;

private:
    /// As radiance(place, w), at a distance t on.
    double radiance(const LayerPlace& place, const Vec3& w, double t) const;
    /// The same of a walk that collides there.
    double source(const LayerPlace& place, const Vec3& w, double t) const;

    /// A layer lit from its near side.
    struct Layer {
        PlanarAdjoint adjoint;
        ModalDirection direction;
    };
    /// One of the two, as a walk sees it.
    struct View {
        const Layer* layer = nullptr;
        double light = 0;
        double depth = 0;
        Vec3 inward{0, 0, 1};  ///< from the side that is lit

        double cosine(const Vec3& w) const { return static_cast<double>(dot(w, inward)); }
    };

public:
    /// Directions after a collision at a place, in proportion to phase function times radiance.
    class Directions {
    public:
        Directions() = default;
        Directions(const LayerGuide& guide, const LayerPlace& place, const Vec3& before);
        Vec3 sample(Pcg32& random) const;
        /// Per steradian.
        double density(const Vec3& w) const;

    private:
        double g_ = 0;
        Vec3 before_{0, 0, 1};
        std::array<View, 2> views_{};
        std::array<double, 2> share_{};
    };

private:
    std::array<View, 2> views(const LayerPlace& place) const;

    double extinction_ = 1;
    double g_ = 0;
    std::vector<std::shared_ptr<const Layer>> layers_;  // thickness 1, 2, 4, ...; the last is infinite
};

}  // namespace wend
