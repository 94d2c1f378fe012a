// Where the boundary of a dense medium is, and from where it is lit, seen from inside.
#pragma once

#include <wend/transport/boundary_light.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

namespace wend {

/// A direction in which more light is to be expected, and how fast the light grows that way.
struct InteriorAim {
    Vec3 normal{0, 0, 1};
    float steepness = 1;  ///< decay over that of a wide plane, in [0, 1]
};

/// How fast light falls off inwards at a depth beneath a curved boundary, over its `decay` beneath a plane: in a ball
/// lit evenly the fluence at a distance r from the centre is sinh(decay r) / r, which falls off L(decay r) times as
/// fast, L(x) = coth x - 1/x. 1 in hollows.
float steepness(float decay, float curvature, float depth);

/// Tables over a grid around an object, from points of its boundary. They only guide: an object may be open or badly
/// oriented. A cell is worked out when a walk first asks for it: few of the cells of a leaf's box are within the leaf.
class BoundaryField {
public:
    /// `box` holds all points; `decay`, per scene unit: how fast light falls off inside.
    BoundaryField(const Box3& box, std::vector<LitPoint> points, float decay);
    BoundaryField(BoundaryField&&) noexcept;
    ~BoundaryField();

    class View;
    /// What is known where a walk is; the field is referred to. Many threads may ask.
    View at(const Vec3& position) const;
    /// Whether a lamp shines on any of its points.
    bool sees_emitters() const;

private:
    static constexpr int side = 24;
    static constexpr int candidates = 6;
    class Pieces;
    class Sources;
    struct Cell {
        std::once_flag once;  ///< the rest is worked out
        std::array<std::uint16_t, candidates> nearest;
        InteriorAim incident;
        float irradiance = 0;  ///< mean over the boundary, as it counts from here
    };
    const Cell& cell_at(const Vec3& position) const;
    void work_out(Cell& cell, const Vec3& centre) const;
    std::size_t closest_point(const Cell& cell, const Vec3& position) const;

    Box3 box_;
    float decay_;  ///< beneath a plane
    std::vector<LitPoint> points_;
    std::unique_ptr<const Pieces> pieces_;
    std::unique_ptr<const Sources> sources_;
    std::unique_ptr<Cell[]> cells_;
};

/// A place within the field.
class BoundaryField::View {
public:
    View(const LitPoint& closest, const Cell& cell, const Vec3& position, float decay)
        : closest_(closest),
          cell_(cell),
          decay_(decay),
          depth_(dot(closest.point.position - position, closest.point.normal)) {}

    /// The outward normal of the nearest piece of boundary, and how steep it is for its curvature.
    InteriorAim closest() const { return {closest_.point.normal, steepness(decay_, closest_.curvature, depth_)}; }
    /// The direction in which the light grows that diffuses inwards from all boundary points, each as a source of
    /// exp(-decay r) / r: with many lights around they share one direction, and where they cancel it has little
    /// steepness (after meng2016, who draws one of the normals).
    const InteriorAim& incident() const { return cell_.incident; }
    /// The lamps seen from the nearest piece of boundary, and the diffuse light: of the irradiance around, `returned`
    /// is the radiance that comes back at the boundary, by channel, and falls off with `decay`, per scene unit.
    EmitterView lamps(const Rgb& returned, const Rgb& decay) const;

private:
    const LitPoint& closest_;
    const Cell& cell_;
    float decay_;
    float depth_;
};

}  // namespace wend
