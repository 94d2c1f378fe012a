// Participating media: what they are made of. How to walk through them is for medium/tracking.h and decision/.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/export.h>
#include <wend/core/transform.h>
#include <wend/core/vector.h>
#include <wend/medium/colour_grid.h>
#include <wend/medium/emission_sampler.h>
#include <wend/medium/grid.h>
#include <wend/medium/homogeneous.h>
#include <wend/medium/majorant_grid.h>
#include <wend/medium/phase.h>

#include <memory>
#include <variant>
#include <vector>

namespace wend {

/// Light that a heterogeneous medium emits: radiance per unit length is the absorption coefficient times at(), or at()
/// itself.
struct WEND_API GridEmission {
    /// Whether it shines by itself, in proportion to nothing.
    bool is_apart = false;
    /// Emitted radiance where `field` is 1, or what multiplies the black body.
    Rgb radiance;
    std::shared_ptr<const Grid> field;          ///< scale or temperature; null: emits wherever it absorbs
    AffineMap field_from_world;                 ///< of colours as well
    std::shared_ptr<const ColourGrid> colours;  ///< multiply `radiance`, in place of a field; null: 1
    std::shared_ptr<const Grid> strength;       ///< multiplies all of it; null: 1
    AffineMap strength_from_world;              ///< to the voxels of `strength`
    /// Radiance of a black body at 0, step, 2 step, ... kelvin; empty if `field` is a plain scale.
    std::vector<Rgb> black_body;
    float black_body_step = 10;    ///< kelvin
    float temperature_offset = 0;  ///< is taken off the field's value before it is scaled
    float temperature_scale = 1;   ///< kelvin per unit of the field

    /// Radiance of the emitter at a point in the world.
    Rgb at(const Vec3& p) const;
};

/// Coefficients of their own at each voxel, per scene unit.
struct VoxelCoefficients {
    ColourGrid absorption;  ///< coefficient
    ColourGrid scattering;  ///< coefficient
};

/// A medium whose coefficients vary in proportion to a density grid, or from voxel to voxel below the bound that such a
/// grid gives.
class WEND_API GridMedium {
public:
    /// Coefficients are per scene unit at density 1. `box` (index space) is where the medium is; density outside is not
    /// looked at.
    GridMedium(std::shared_ptr<const Grid> density, const Transform& index_from_world, const Box3& box,
               const Rgb& absorption, const Rgb& scattering, const PhaseFunction& phase,
               std::shared_ptr<const GridEmission> emission = nullptr);

    /// The same with coefficients of each voxel; none may have an extinction above `density` there, which has the same
    /// voxels. `absorption` and `scattering`, a mean over the medium, tell its albedo where one is asked for.
    GridMedium(std::shared_ptr<const Grid> density, const Transform& index_from_world, const Box3& box,
               std::shared_ptr<const VoxelCoefficients> voxels, const Rgb& absorption, const Rgb& scattering,
               const PhaseFunction& phase, std::shared_ptr<const GridEmission> emission = nullptr);

    /// Not null where voxels have coefficients of their own: density is a bound of their extinction then.
    const VoxelCoefficients* voxels() const { return voxels_.get(); }
    /// Coefficient at density 1.
    const Rgb& absorption() const { return absorption_; }
    /// Coefficient at density 1.
    const Rgb& scattering() const { return scattering_; }
    /// Extinction at density 1; 1 where that is a bound.
    const Rgb& extinction() const { return extinction_; }
    /// Where collisions send light.
    const PhaseFunction& phase() const { return phase_; }
    /// The light of its own; null where there is none.
    const GridEmission* emission() const { return emission_.get(); }
    /// Where the medium can be connected to for its light; null where it emits none.
    const EmissionSampler* glow() const { return glow_.get(); }
    /// Radiance emitted per unit length at a point in the world; the medium must have an emission.
    Rgb emitted_at(const Vec3& p) const {
        if (emission_->is_apart) {
            return emission_->at(p);
        }
        const Vec3 q = index_from_world_.point(p);
        return voxels_ ? voxels_->absorption.interpolate(q) * emission_->at(p)
                       : absorption_ * emission_->at(p) * density_->interpolate(q);
    }
    /// What the coefficients are in proportion to, or a bound.
    const Grid& density() const { return *density_; }
    /// Bounds of the density.
    const MajorantGrid& majorants() const { return majorants_; }

    /// A world-space ray in index space: t stays a distance in the world.
    struct IndexRay {
        Vec3 origin;     ///< in index space
        Vec3 direction;  ///< for a unit of length in the world
        /// The point at a distance in the world.
        Vec3 at(float t) const { return origin + direction * t; }
    };
    /// The ray as the grid sees it.
    IndexRay to_index(const Ray& ray) const {
        return {index_from_world_.point(ray.origin), index_from_world_.vector(ray.direction)};
    }
    /// Tentative collisions per unit length that a walk should look at for the medium's own light to be seen where it
    /// is thin: several along the part of a ray, up to a length, that is in it. 0 where it does not glow.
    float looks(const IndexRay& ray, float length) const;

private:
    void find_glow(const Box3& box, const Transform& index_from_world);

    std::shared_ptr<const Grid> density_;
    std::shared_ptr<const VoxelCoefficients> voxels_;
    AffineMap index_from_world_;
    MajorantGrid majorants_;
    Rgb absorption_;
    Rgb scattering_;
    Rgb extinction_;
    PhaseFunction phase_;
    std::shared_ptr<const GridEmission> emission_;
    std::shared_ptr<const EmissionSampler> glow_;
};

/// Of either kind.
inline const PhaseFunction& phase_function(const Medium& medium) {
    if (const auto* homogeneous = std::get_if<HomogeneousMedium>(&medium)) {
        return homogeneous->phase;
    }
    return std::get<GridMedium>(medium).phase();
}

/// Extinction at a point in the world, per scene unit.
WEND_API Rgb extinction_at(const Medium& medium, const Vec3& position);

/// Whether a collision can be anything but absorption.
WEND_API bool scatters(const Medium& medium);

/// Single-scattering albedo: the same at every density, or a mean where voxels have albedos of their own.
WEND_API Rgb albedo(const Medium& medium);

}  // namespace wend
