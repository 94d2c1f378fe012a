// Where the boundary of a dense medium is, and from where it is lit, seen from inside.
#pragma once

#include <wend/decision/lamp_guide.h>
#include <wend/decision/layer_guide.h>
#include <wend/scene/boundary_points.h>
#include <wend/scene/scene.h>

#include <span>
#include <vector>

namespace wend {

/// A direction in which more light is to be expected, and how fast the light grows that way.
struct SlabAim {
    Vec3 normal{0, 0, 1};
    float steepness = 1;  ///< decay over that of a wide plane, in [0, 1]
};

/// A point of the boundary with what a walk inside wants to know of it.
struct LitPoint {
    BoundaryPoint point;
    float irradiance = 0;         ///< of light from outside
    float thickness = 0;          ///< of the object, straight inwards
    float irradiance_behind = 0;  ///< where that way leaves the object
    /// Lights outside that walks may run into, or be connected to at the boundary; the strongest come first.
    std::array<BoundaryLamp, LampGuide::most> lamps{};
    int lamp_count = 0;
};

/// Tables over a grid around an object, made once from points of its boundary. They only guide: an object may be open
/// or badly oriented.
class BoundaryField {
public:
    /// `box` holds all points; `decay`, per scene unit: how fast light falls off inside.
    BoundaryField(const Box3& box, std::vector<LitPoint> points, float decay, int threads);

    class View;
    /// What is known where a walk is; the field is referred to.
    View at(const Vec3& position) const;

private:
    static constexpr int side = 24;
    static constexpr int candidates = 6;
    struct Cell {
        std::array<std::uint16_t, candidates> nearest;
        SlabAim incident;
        float irradiance = 0;  ///< mean over the boundary, as it counts from here
    };
    std::size_t cell_at(const Vec3& position) const;
    const LitPoint& closest_point(const Cell& cell, const Vec3& position) const;
    /// Square of that to the flat piece of surface that a point stands for.
    float distance2_to(const BoundaryPoint& point, const Vec3& position) const;

    Box3 box_;
    float spacing_;  ///< of the points
    std::vector<LitPoint> points_;
    std::vector<Cell> cells_;
};

/// How the boundary refracts, taken to be the same all over.
struct BoundarySurface {
    float ior = 1;    ///< of the inside over the outside
    float alpha = 0;  ///< roughness of the microfacets

    /// The concentration of a vMF lobe that blurs directions inside as the roughness does.
    float blur() const;
};

/// A place within the field.
class BoundaryField::View {
public:
    View(const LitPoint& closest, const Cell& cell, const Vec3& position)
        : closest_(closest), cell_(cell), depth_(dot(closest.point.position - position, closest.point.normal)) {}

    /// The outward normal of the nearest piece of boundary.
    SlabAim closest() const { return {closest_.point.normal, 1}; }
    /// The layer between that piece and the boundary behind it.
    LayerPlace layer() const;
    /// The direction in which the light grows that diffuses inwards from all boundary points, each as a source of
    /// exp(-decay r) / r: with many lights around they share one direction, and where they cancel it has little
    /// steepness (after meng2016, who draws one of the normals).
    const SlabAim& incident() const { return cell_.incident; }
    /// The lamps seen from the nearest piece of boundary; `diffuse`: the light that arrives at the boundary around and
    /// diffuses inwards, as an irradiance, before it is attenuated on the way from the nearest piece.
    LampView lamps() const;

private:
    const LitPoint& closest_;
    const Cell& cell_;
    float depth_;
};

/// Points with the irradiance by lights outside, directly, as a scalar; never quite 0, for the light that comes
/// otherwise. Ways that leave an open object count as its diameter.
std::vector<LitPoint> lit_points(const Scene& scene, MediumId medium, std::span<const BoundaryPoint> points,
                                 const BoundarySurface& boundary, int samples, Pcg32& random);

/// The mean length of chords through the object, 4 volume / area, by rays inwards from its boundary. Those that leave
/// an open object count as its diameter.
float mean_chord(const Scene& scene, MediumId medium, std::span<const BoundaryPoint> points, Pcg32& random);

}  // namespace wend
