#include <wend/sampling/discrete.h>
#include <wend/sampling/sobol.h>
#include <wend/scene/boundary_points.h>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// Where an object stands.
struct Placement {
    AffineMap to_world;
    AffineMap from_world;
};

/// A triangle, sphere or disk.
struct Element {
    const Surface* surface;
    std::uint32_t primitive;
    std::uint32_t placement;
};

Vec3 random_point(const Sphere& sphere, const Vec2& u) {
    return to_sphere(u) * sphere.radius;
}
Vec3 random_point(const Disk& disk, const Vec2& u) {
    const Vec2 p = to_disk(u) * disk.radius;
    return {p.x, p.y, disk.height};
}
float area_of(const Sphere& sphere) {
    return 4 * pi * sqr(sphere.radius);
}
float area_of(const Disk& disk) {
    return pi * sqr(disk.radius);
}

class BoundarySampler {
public:
    BoundarySampler(const SceneDescription& scene, MediumId medium) : medium_(medium) {
        const auto place = [&](const std::vector<int>& surfaces, const Placement& placement) {
            placements_.push_back(placement);
            for (const int i : surfaces) {
                add_surface(scene.surfaces[static_cast<std::size_t>(i)]);
            }
        };
        place(scene.world_surfaces, {});
        for (const Instance& instance : scene.instances) {
            place(scene.objects[static_cast<std::size_t>(instance.object)].surfaces,
                  {AffineMap(instance.world_from_object), AffineMap(instance.world_from_object.inverse())});
        }
        table_ = AliasTable(areas_);
    }

    bool is_empty() const { return elements_.empty(); }

    BoundaryPoint sample(float u, const Vec2& u2) const {
        const Element& element = elements_[static_cast<std::size_t>(table_.sample(u))];
        const Surface& surface = *element.surface;
        BoundaryPoint point;
        if (const auto* mesh = std::get_if<TriangleMesh>(&surface.shape)) {
            const Vec3 p0 = mesh->vertex(element.primitive, 0);
            const Vec3 e1 = mesh->vertex(element.primitive, 1) - p0;
            const Vec3 e2 = mesh->vertex(element.primitive, 2) - p0;
            const Vec2 b = to_triangle(u2);
            point.position = p0 + e1 * b.x + e2 * b.y;
            point.normal = cross(e1, e2);
            if (mesh->normals.empty()) {
                point.normal = surface.flip_normal ? -point.normal : point.normal;
            } else if (dot(point.normal, mesh->normals[mesh->indices[3 * element.primitive]]) < 0) {
                point.normal = -point.normal;
            }
        } else {
            const auto& quadric = std::get<Quadric>(surface.shape);
            const QuadricPoint on =
                project(quadric, std::visit([&](const auto& s) { return random_point(s, u2); }, quadric.shape));
            point.position = quadric.world_from_object.point(on.position);
            point.normal = quadric.object_from_world.transposed_vector(on.normal);
            point.normal = surface.flip_normal ? -point.normal : point.normal;
        }
        const Placement& placement = placements_[element.placement];
        point.position = placement.to_world.point(point.position);
        point.normal = normalize(placement.from_world.transposed_vector(point.normal));
        point.normal = surface.interior == medium_ ? point.normal : -point.normal;
        return point;
    }

private:
    /// Of the last placement.
    void add_surface(const Surface& surface) {
        if ((surface.interior == medium_) == (surface.exterior == medium_)) {
            return;
        }
        const AffineMap& to = placements_.back().to_world;
        if (const auto* mesh = std::get_if<TriangleMesh>(&surface.shape)) {
            for (std::size_t i = 0; i < mesh->triangle_count(); ++i) {
                const Vec3 e1 = to.vector(mesh->vertex(i, 1) - mesh->vertex(i, 0));
                const Vec3 e2 = to.vector(mesh->vertex(i, 2) - mesh->vertex(i, 0));
                add_element(surface, i, 0.5f * length(cross(e1, e2)));
            }
        } else {
            const auto& quadric = std::get<Quadric>(surface.shape);
            const auto edge = [&](const Vec3& axis) { return to.vector(quadric.world_from_object.vector(axis)); };
            const float volume = std::abs(dot(edge({1, 0, 0}), cross(edge({0, 1, 0}), edge({0, 0, 1}))));
            const float scale = std::cbrt(volume);
            add_element(surface, 0,
                        scale * scale * std::visit([](const auto& s) { return area_of(s); }, quadric.shape));
        }
    }
    void add_element(const Surface& surface, std::size_t primitive, float area) {
        if (area > 0 && std::isfinite(area)) {
            elements_.push_back(
                {&surface, static_cast<std::uint32_t>(primitive), static_cast<std::uint32_t>(placements_.size() - 1)});
            areas_.push_back(area);
        }
    }

    MediumId medium_;
    std::vector<Placement> placements_;
    std::vector<Element> elements_;
    std::vector<float> areas_;
    AliasTable table_;
};

}  // namespace

std::vector<BoundaryPoint> boundary_points(const SceneDescription& scene, MediumId medium, int count,
                                           std::uint64_t seed) {
    const BoundarySampler sampler(scene, medium);
    std::vector<BoundaryPoint> points;
    for (int i = 0; i < count && !sampler.is_empty(); ++i) {
        const auto index = static_cast<std::uint32_t>(i);
        const BoundaryPoint point =
            sampler.sample(owen_sobol(index, hash_of(seed, 0)).x, owen_sobol(index, hash_of(seed, 1)));
        if (is_finite(point.position) && is_finite(point.normal)) {
            points.push_back(point);
        }
    }
    return points;
}

std::vector<float> mean_curvatures(std::span<const BoundaryPoint> points) {
    constexpr std::size_t neighbours = 12;
    std::vector<float> result;
    result.reserve(points.size());
    for (const BoundaryPoint& point : points) {
        std::vector<std::pair<float, const BoundaryPoint*>> around;
        for (const BoundaryPoint& other : points) {
            if (dot(other.normal, point.normal) > 0) {
                around.emplace_back(length_squared(other.position - point.position), &other);
            }
        }
        const auto few = static_cast<std::ptrdiff_t>(std::min(neighbours + 1, around.size()));
        std::partial_sort(around.begin(), around.begin() + few, around.end());
        // The normal curvature towards each, weighted with its square distance; its mean over directions is the mean
        // curvature.
        float turn = 0, distance2 = 0;
        for (const auto& [d2, other] : std::span(around).first(static_cast<std::size_t>(few))) {
            turn += dot(other->normal - point.normal, other->position - point.position);
            distance2 += d2;
        }
        result.push_back(distance2 > 0 ? turn / distance2 : 0.0f);
    }
    return result;
}

Box3 bounds_of(std::span<const BoundaryPoint> points) {
    Box3 box;
    for (const BoundaryPoint& point : points) {
        box.extendBy(point.position);
    }
    return box;
}

}  // namespace wend
