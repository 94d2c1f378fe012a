#include <wend/io/load/reach.h>

#include <fmt/format.h>

#include <cmath>

namespace wend {
namespace {

/// Of spheres, disks and cylinders, which need no products of lengths: rays that reach them are still rays to Embree.
constexpr float farthest_quadric = 1e16f;

void require_within(const Place& place, std::string_view what, const Vec3& point, float bound) {
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(point[axis]) <= bound)) {
            throw InputError(place, fmt::format("{} at ({}, {}, {}): coordinates must stay within {}", what, point.x,
                                                point.y, point.z, bound));
        }
    }
}

}  // namespace

void require_near(const Place& place, std::string_view what, const Vec3& point) {
    require_within(place, what, point, farthest);
}

Box3 require_near(const Place& place, std::string_view what, const Shape& shape) {
    Box3 box;
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
        for (const auto* const positions : {&mesh->positions, &mesh->end_positions}) {
            for (const Vec3& position : *positions) {
                require_near(place, what, position);
                box.extendBy(position);
            }
        }
        return box;
    }
    box = bounds(shape);
    if (std::holds_alternative<CurveSet>(shape)) {
        require_near(place, what, box.min);
        require_near(place, what, box.max);
        return box;
    }
    require_within(place, what, box.min, farthest_quadric);
    require_within(place, what, box.max, farthest_quadric);
    return box;
}

void require_near(const Place& place, const Box3& object, const Transform& world_from_object) {
    for (int corner = 0; corner < 8 && !object.isEmpty(); ++corner) {
        const auto side = [&](int axis) { return (corner >> axis) % 2 == 0 ? object.min[axis] : object.max[axis]; };
        require_near(place, "an instance reaches to a point", world_from_object.point({side(0), side(1), side(2)}));
    }
    // Rays start within `farthest`, and must stay well inside of what Embree takes.
    constexpr double largest_scale = 1e8;
    const Transform inverse = world_from_object.inverse();
    for (int row = 0; row < 3; ++row) {
        for (int column = 0; column < 3; ++column) {
            if (!(std::abs(inverse.element(row, column)) <= largest_scale)) {
                throw InputError(place,
                                 fmt::format("an instance is made smaller than by a factor of {}", 1 / largest_scale));
            }
        }
    }
}

}  // namespace wend
