#include <wend/scene/moving_light.h>

#include <array>
#include <cmath>
#include <span>
#include <variant>

namespace wend {
namespace {

float volume_factor(const AffineMap& map) {
    return std::abs(dot(cross(map.vector({1, 0, 0}), map.vector({0, 1, 0})), map.vector({0, 0, 1})));
}

/// Whether a motion shifts, and does nothing else.
bool keeps_directions(const Motion& motion) {
    for (std::size_t i = 1; i < motion.key_count(); ++i) {
        for (int row = 0; row < 3; ++row) {
            for (int column = 0; column < 3; ++column) {
                if (motion.key(i).element(row, column) != motion.start().element(row, column)) {
                    return false;
                }
            }
        }
    }
    return true;
}

/// Between its keys a motion, and what it moves, are mixtures of what they are at the keys.
Box3 swept(const Motion& motion, std::span<const Vec3> points) {
    Box3 box;
    for (std::size_t i = 0; i < motion.key_count(); ++i) {
        for (const Vec3& p : points) {
            box.extendBy(motion.key(i).point(p));
        }
    }
    return box;
}

}  // namespace

PlacedTriangle placed_at(const TriangleLight& light, float time) {
    if (!light.motion) {
        return {light.p0, light.p1, light.p2, light.normal, light.area};
    }
    const TriangleMotion& motion = *light.motion;
    std::array<Vec3, 3> p = {light.p0, light.p1, light.p2};
    for (std::size_t k = 0; k < 3; ++k) {
        p[k] = p[k] * (1 - time) + motion.end[k] * time;
    }
    Vec3 normal = cross(p[1] - p[0], p[2] - p[0]);
    if (motion.placement) {
        const Placement placement = motion.placement->at(time);
        for (Vec3& corner : p) {
            corner = placement.world_from_object.point(corner);
        }
        normal = placement.object_from_world.transposed_vector(normal);
    }
    const float size = length(normal);
    normal = size > 0 ? normal * ((motion.flip ? -1 : 1) / size) : Vec3(0, 0, 1);
    return {p[0], p[1], p[2], normal, 0.5f * length(cross(p[1] - p[0], p[2] - p[0]))};
}

PlacedQuadric::PlacedQuadric(const QuadricLight& light, float time)
    : quadric_(*light.quadric), determinant_(light.determinant) {
    if (light.motion) {
        moved_ = light.motion->at(time);
        determinant_ *= volume_factor(moved_->world_from_object);
    }
}

Vec3 PlacedQuadric::to_object(const Vec3& p) const {
    return quadric_.object_from_world.point(moved_ ? moved_->object_from_world.point(p) : p);
}

Vec3 PlacedQuadric::to_world(const Vec3& p) const {
    const Vec3 at_rest = quadric_.world_from_object.point(p);
    return moved_ ? moved_->world_from_object.point(at_rest) : at_rest;
}

Vec3 PlacedQuadric::normal(const Vec3& n) const {
    const Vec3 at_rest = quadric_.object_from_world.transposed_vector(n);
    return moved_ ? moved_->object_from_world.transposed_vector(at_rest) : at_rest;
}

LightExtent extent_over_time(const TriangleLight& light) {
    const std::array<Vec3, 3> corners = {light.p0, light.p1, light.p2};
    if (!light.motion) {
        Box3 box;
        for (const Vec3& p : corners) {
            box.extendBy(p);
        }
        return {box, light.normal};
    }
    const TriangleMotion& motion = *light.motion;
    const std::array<Vec3, 6> all = {corners[0], corners[1], corners[2], motion.end[0], motion.end[1], motion.end[2]};
    const Motion placement = motion.placement ? *motion.placement : Motion();
    const bool turns = motion.end != corners || !keeps_directions(placement);
    return {swept(placement, all), turns ? std::nullopt : std::optional(light.normal)};
}

LightExtent extent_over_time(const QuadricLight& light) {
    const Box3 box = bounds(*light.quadric);
    std::optional<Vec3> axis;
    if (std::holds_alternative<Disk>(light.quadric->shape) && (!light.motion || keeps_directions(*light.motion))) {
        axis = normalize(PlacedQuadric(light, 0).normal({0, 0, 1})) * light.flip;
    }
    if (!light.motion) {
        return {box, axis};
    }
    std::array<Vec3, 8> corners;
    for (std::size_t i = 0; i < 8; ++i) {
        corners[i] = {i & 1 ? box.max.x : box.min.x, i & 2 ? box.max.y : box.min.y, i & 4 ? box.max.z : box.min.z};
    }
    return {swept(*light.motion, corners), axis};
}

}  // namespace wend
