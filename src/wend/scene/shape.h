// Shapes as data. World space, except that quadrics keep their own space and the map to the world.
#pragma once

#include <wend/core/transform.h>
#include <wend/core/vector.h>
#include <wend/scene/curve.h>

#include <array>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <optional>
#include <utility>
#include <variant>
#include <vector>

namespace wend {

/// Triangles in world space. `normals`, `uvs` and `tangents` are empty or have one entry a vertex.
///
/// A mesh may change its shape: then vertices and normals move evenly from where they are at time 0 to where they are
/// at time 1 (Ray::time). Whoever does not ask for a time sees it at time 0.
struct TriangleMesh {
    std::vector<Vec3> positions;
    std::vector<Vec3> normals;
    std::vector<Vec2> uvs;
    std::vector<std::uint32_t> indices;  ///< three a triangle
    std::vector<Vec3> end_positions{};   ///< at time 1; empty where nothing moves
    std::vector<Vec3> end_normals{};     ///< at time 1; empty where nothing moves, or there are no normals
    std::vector<Vec3> tangents{};        ///< along which a surface is brushed; without them, along u
    /// From this triangle on, two in a row are a quadrilateral: its corners 0, 1, 2 and 0, 2, 3.
    std::size_t first_quadrilateral = std::numeric_limits<std::size_t>::max();

    bool is_moving() const { return !end_positions.empty(); }
    std::size_t triangle_count() const { return indices.size() / 3; }
    /// Whether a triangle is the second one of a quadrilateral.
    bool is_second_half(std::size_t i) const { return i >= first_quadrilateral && (i - first_quadrilateral) % 2 == 1; }
    /// The texture coordinates of a triangle's second and third corner where there are no others, as pbrt has them; the
    /// first one's are (0,0).
    std::array<Vec2, 2> default_uvs(std::size_t i) const {
        return is_second_half(i) ? std::array{Vec2(1, 1), Vec2(0, 1)} : std::array{Vec2(1, 0), Vec2(1, 1)};
    }
    Vec3 vertex(std::size_t triangle, int corner) const {
        return positions[indices[3 * triangle + static_cast<std::size_t>(corner)]];
    }
    /// The corners of a triangle at a time from 0 to 1.
    std::array<Vec3, 3> triangle(std::size_t i, float time) const { return at(positions, end_positions, i, time); }
    /// The normals there, not of unit length between the ends; there must be normals.
    std::array<Vec3, 3> corner_normals(std::size_t i, float time) const { return at(normals, end_normals, i, time); }

private:
    std::array<Vec3, 3> at(const std::vector<Vec3>& start, const std::vector<Vec3>& end, std::size_t i,
                           float time) const {
        const std::uint32_t* const corner = &indices[3 * i];
        std::array<Vec3, 3> values = {start[corner[0]], start[corner[1]], start[corner[2]]};
        for (std::size_t k = 0; k < 3 && !end.empty(); ++k) {
            // As Embree has it.
            values[k] = values[k] * (1 - time) + end[corner[k]] * time;
        }
        return values;
    }
};

/// A sphere around the origin of its space, cut at z_min, z_max and the sweep angle phi_max (radians).
struct Sphere {
    float radius = 1;
    float z_min = -1;
    float z_max = 1;
    float phi_max = 6.28318530717958648f;

    bool is_full() const { return z_min <= -radius && z_max >= radius && phi_max >= 6.283185f; }
};

/// An annulus at z = height.
struct Disk {
    float height = 0;
    float radius = 1;
    float inner_radius = 0;
    float phi_max = 6.28318530717958648f;
};

/// A cylinder about the z axis of its space, open at both ends.
struct Cylinder {
    float radius = 1;
    float z_min = -1;
    float z_max = 1;
    float phi_max = 6.28318530717958648f;
};

/// A sphere or disk with its place in the world.
struct Quadric {
    std::variant<Sphere, Disk> shape;
    AffineMap world_from_object;
    AffineMap object_from_world;

    Quadric(std::variant<Sphere, Disk> s, const Transform& to_world)
        : shape(std::move(s)), world_from_object(to_world), object_from_world(to_world.inverse()) {}
};

/// A cylinder with its place in the world. It is no quadric because it never shines nor bounds a medium: a mesh stands
/// for one that does.
struct CylinderShell {
    Cylinder shape;
    AffineMap world_from_object;
    AffineMap object_from_world;

    CylinderShell(const Cylinder& s, const Transform& to_world)
        : shape(s), world_from_object(to_world), object_from_world(to_world.inverse()) {}
};

/// Where a line meets a quadric: at most twice.
struct QuadricCrossings {
    struct Crossing {
        float t;
        bool along;  ///< the normal is along the line
    };
    std::array<Crossing, 2> at;
    int count = 0;

    void add(float t, bool along) { at[static_cast<std::size_t>(count++)] = {t, along}; }
    const Crossing* begin() const { return at.data(); }
    const Crossing* end() const { return at.data() + count; }
};

/// In their order along the line, behind its origin too. `origin` and `direction` (any length) are in object space.
QuadricCrossings crossings(const Quadric& quadric, const Vec3& origin, const Vec3& direction);
QuadricCrossings crossings(const CylinderShell& cylinder, const Vec3& origin, const Vec3& direction);

/// Surface parameters in [0,1]² of a point on the quadric (object space).
Vec2 parameters(const Quadric& quadric, const Vec3& p);
Vec2 parameters(const CylinderShell& cylinder, const Vec3& p);

/// A point near the surface moved onto it, its normal (outward; disk: +z) and its tangent along u; object space, not
/// normalized.
struct QuadricPoint {
    Vec3 position;
    Vec3 normal;
    Vec3 dpdu;
    Vec3 normal_slope;  ///< where the point moves along the surface, the normal changes by so many times as much
};
QuadricPoint project(const Quadric& quadric, const Vec3& p);
QuadricPoint project(const CylinderShell& cylinder, const Vec3& p);

/// How the point moves with each of the surface parameters, object space.
struct QuadricTangents {
    Vec3 dpdu, dpdv;
};
QuadricTangents tangents(const Quadric& quadric, const Vec3& p);
QuadricTangents tangents(const CylinderShell& cylinder, const Vec3& p);

/// The largest coordinate of any of its points, at most, in object space.
float extent(const Quadric& quadric);
float extent(const CylinderShell& cylinder);

/// Bounds in the world.
Box3 bounds(const Quadric& quadric);
Box3 bounds(const CylinderShell& cylinder);

using Shape = std::variant<TriangleMesh, Quadric, CylinderShell, CurveSet>;

/// A shape that does not change any more: copies are the same shape, which surfaces and scenes so have together.
class SharedShape {
public:
    template <class T>
    requires std::constructible_from<Shape, T&&> SharedShape(T&& shape)
        : shape_(std::make_shared<const Shape>(std::forward<T>(shape))) {}

    const Shape& operator*() const { return *shape_; }
    const Shape* get() const { return shape_.get(); }
    /// Whether they are one, and not just alike.
    friend bool operator==(const SharedShape&, const SharedShape&) = default;

private:
    std::shared_ptr<const Shape> shape_;
};

/// Bounds in the world, at all times.
Box3 bounds(const Shape& shape);

/// Whether the shape itself changes with time.
inline bool is_moving(const Shape& shape) {
    const auto* mesh = std::get_if<TriangleMesh>(&shape);
    return mesh && mesh->is_moving();
}

}  // namespace wend
