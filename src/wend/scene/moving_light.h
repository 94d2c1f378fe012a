// Where area lights are at a time.
#pragma once

#include <wend/core/vector.h>
#include <wend/scene/light.h>

#include <optional>

namespace wend {

/// A triangle that shines, as it stands at a time.
struct PlacedTriangle {
    Vec3 p0, p1, p2;
    Vec3 normal;  ///< unit length, the emitting side
    float area;
};
PlacedTriangle placed_at(const TriangleLight& light, float time);

/// A quadric that shines, as it stands at a time: its own space and the world.
class PlacedQuadric {
public:
    PlacedQuadric(const QuadricLight& light, float time);

    /// A point of the world in the quadric's space, and back.
    Vec3 to_object(const Vec3& p) const;
    Vec3 to_world(const Vec3& p) const;
    /// A normal of the quadric's space in the world; of unit length, the world's area over the object's is
    /// `area_factor()` times its length.
    Vec3 normal(const Vec3& n) const;
    float area_factor() const { return determinant_; }

private:
    const Quadric& quadric_;
    std::optional<Placement> moved_;
    float determinant_;
};

/// What a light takes up, and where its normals point to, over all times.
struct LightExtent {
    Box3 box;
    std::optional<Vec3> axis;  ///< of flat lights that do not turn: the only normal, of unit length
};
LightExtent extent_over_time(const TriangleLight& light);
LightExtent extent_over_time(const QuadricLight& light);

}  // namespace wend
