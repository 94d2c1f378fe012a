// Curves with a width: hair, fur, grass. World space.
#pragma once

#include <wend/core/vector.h>

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

namespace wend {

/// A cubic Bezier curve whose width goes from the first to the last of two, linearly in the curve's parameter.
struct CurveSegment {
    std::array<Vec3, 4> points;
    std::array<float, 2> width{1, 1};
    std::array<Vec3, 2> normals{Vec3(0, 0, 0), Vec3(0, 0, 0)};  ///< of ribbons, at both ends; of unit length

    Vec3 at(float u) const;
    /// The derivative by u.
    Vec3 along(float u) const;
    float width_at(float u) const { return width[0] + (width[1] - width[0]) * u; }
    /// Of a ribbon: turns from the first to the last at an even speed.
    Vec3 normal_at(float u) const;
};

/// Curves of one kind. Each segment is a number of pieces of the same length in u, which are the primitives.
struct CurveSet {
    enum class Kind {
        flat,      ///< ribbons that face whatever ray meets them
        cylinder,  ///< the same, with the normals of a cylinder
        ribbon,    ///< ribbons with normals of their own
        round      ///< tubes
    };

    Kind kind = Kind::flat;
    std::uint32_t pieces = 1;  ///< of a segment
    std::vector<CurveSegment> segments;

    std::size_t primitive_count() const { return segments.size() * pieces; }
    const CurveSegment& segment_of(std::uint32_t primitive) const { return segments[primitive / pieces]; }
};

/// Where a ray meets a curve.
struct CurveCrossing {
    float t;
    float u;  ///< along its segment, in [0, 1]
    float v;  ///< across, in [0, 1]
};

/// Decides about a crossing by its t: a function of the caller's, which it does not own.
class CrossingFilter {
public:
    template <class Accept>
    explicit CrossingFilter(const Accept& accept)
        : accept_(&accept), call_([](const void* f, float t) { return (*static_cast<const Accept*>(f))(t); }) {}

    bool operator()(float t) const { return call_(accept_, t); }

private:
    const void* accept_;
    bool (*call_)(const void*, float);
};

/// Where a line meets a primitive next with t in (t_min, t_max), of those that are `accepted`. A ribbon lies in the
/// depth of the curve that it is drawn around, as in pbrt (pharr2023, section 6.7).
std::optional<CurveCrossing> next_crossing(const CurveSet& curves, std::uint32_t primitive, const Vec3& origin,
                                           const Vec3& direction, float t_min, float t_max,
                                           const CrossingFilter& accepted);

/// The surface where a ray of this direction has met a primitive.
struct CurvePoint {
    Vec3 normal;  ///< not normalized; of flat curves and cylinders away from where the ray comes from, as in pbrt
    Vec3 dpdu;
    float width;  ///< as the ray sees it
};
CurvePoint curve_point(const CurveSet& curves, std::uint32_t primitive, float u, float v, const Vec3& direction);

/// Bounds of a primitive.
Box3 bounds(const CurveSet& curves, std::uint32_t primitive);
Box3 bounds(const CurveSet& curves);

}  // namespace wend
