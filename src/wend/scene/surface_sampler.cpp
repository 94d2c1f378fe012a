#include <wend/scene/surface_sampler.h>

#include <cmath>
#include <variant>

namespace wend {
namespace {

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

}  // namespace

SurfaceSampler::SurfaceSampler(const SceneDescription& scene, const std::function<bool(const Surface&)>& is_chosen) {
    const auto place = [&](const std::vector<int>& surfaces, const Motion& motion) {
        placements_.push_back(motion.at(0));
        motions_.push_back(motion.is_moving() ? &motion : nullptr);
        for (const int i : surfaces) {
            if (const Surface& surface = scene.surfaces[static_cast<std::size_t>(i)]; is_chosen(surface)) {
                add_surface(surface);
            }
        }
    };
    place(scene.world_surfaces, Motion());
    for (const Instance& instance : scene.instances) {
        place(scene.objects[static_cast<std::size_t>(instance.object)].surfaces, instance.world_from_object);
    }
    table_ = AliasTable(areas_);
}

SurfaceSampler::Point SurfaceSampler::sample(float u, const Vec2& u2, float time) const {
    const Element& element = elements_[static_cast<std::size_t>(table_.sample(u))];
    const Surface& surface = *element.surface;
    // Of curves and cylinders there are none: see add_surface().
    Point point{&surface, {}, {}};
    if (const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get())) {
        const auto [p0, p1, p2] = mesh->triangle(element.primitive, time);
        const Vec3 e1 = p1 - p0;
        const Vec3 e2 = p2 - p0;
        const Vec2 b = to_triangle(u2);
        point.position = p0 + e1 * b.x + e2 * b.y;
        point.normal = cross(e1, e2);
        if (mesh->normals.empty()) {
            point.normal = surface.flip_normal ? -point.normal : point.normal;
        } else if (dot(point.normal, mesh->corner_normals(element.primitive, time)[0]) < 0) {
            point.normal = -point.normal;
        }
    } else {
        const auto& quadric = std::get<Quadric>(*surface.shape);
        const QuadricPoint on =
            project(quadric, std::visit([&](const auto& s) { return random_point(s, u2); }, quadric.shape));
        point.position = quadric.world_from_object.point(on.position);
        point.normal = quadric.object_from_world.transposed_vector(on.normal);
        point.normal = surface.flip_normal ? -point.normal : point.normal;
    }
    const Motion* const motion = motions_[element.placement];
    const Placement placement = motion ? motion->at(time) : placements_[element.placement];
    point.position = placement.world_from_object.point(point.position);
    point.normal = normalize(placement.object_from_world.transposed_vector(point.normal));
    return point;
}

void SurfaceSampler::add_surface(const Surface& surface) {
    const AffineMap& to = placements_.back().world_from_object;
    if (const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get())) {
        for (std::size_t i = 0; i < mesh->triangle_count(); ++i) {
            const Vec3 e1 = to.vector(mesh->vertex(i, 1) - mesh->vertex(i, 0));
            const Vec3 e2 = to.vector(mesh->vertex(i, 2) - mesh->vertex(i, 0));
            add_element(surface, i, 0.5f * length(cross(e1, e2)));
        }
    } else if (const auto* found = std::get_if<Quadric>(surface.shape.get())) {
        const Quadric& quadric = *found;
        const auto edge = [&](const Vec3& axis) { return to.vector(quadric.world_from_object.vector(axis)); };
        const float volume = std::abs(dot(edge({1, 0, 0}), cross(edge({0, 1, 0}), edge({0, 0, 1}))));
        const float scale = std::cbrt(volume);
        add_element(surface, 0, scale * scale * std::visit([](const auto& s) { return area_of(s); }, quadric.shape));
    }
}

void SurfaceSampler::add_element(const Surface& surface, std::size_t primitive, float area) {
    if (area > 0 && std::isfinite(area)) {
        elements_.push_back(
            {&surface, static_cast<std::uint32_t>(primitive), static_cast<std::uint32_t>(placements_.size() - 1)});
        areas_.push_back(area);
        area_ += area;
    }
}

}  // namespace wend
