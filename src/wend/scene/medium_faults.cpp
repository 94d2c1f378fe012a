#include <wend/scene/medium_faults.h>

#include <algorithm>
#include <limits>
#include <optional>

namespace wend {
namespace {

constexpr std::size_t most_meetings = 8;
constexpr int most_pairs = 64;
/// Of each surface, points that are tried.
constexpr std::size_t most_points = 8;

/// Calls f(t, along) where a line meets a surface in the world; `along`: whether the normal is along the line.
template <class F>
void for_each_crossing(const Surface& surface, const Vec3& from, const Vec3& along, F&& f) {
    if (const auto* quadric = std::get_if<Quadric>(surface.shape.get())) {
        const Vec3 origin = quadric->object_from_world.point(from), way = quadric->object_from_world.vector(along);
        for (const auto& crossing : crossings(*quadric, origin, way)) {
            f(static_cast<double>(crossing.t), crossing.along != surface.flip_normal);
        }
        return;
    }
    // Only meshes and quadrics bound media.
    const auto& mesh = std::get<TriangleMesh>(*surface.shape);
    const Imath::V3d o(from), d(along);
    for (std::size_t i = 0; i < mesh.triangle_count(); ++i) {
        const Imath::V3d p(mesh.vertex(i, 0)), a = Imath::V3d(mesh.vertex(i, 1)) - p,
                                               b = Imath::V3d(mesh.vertex(i, 2)) - p;
        const Imath::V3d normal = a.cross(b), q = o - p;
        const double facing = d.dot(normal);
        if (facing == 0) {
            continue;
        }
        // Barycentric coordinates, all times `facing`.
        const Imath::V3d r = d.cross(q);
        const double u = -b.dot(r) / facing, v = a.dot(r) / facing;
        if (u < 0 || v < 0 || u + v > 1) {
            continue;
        }
        const bool turned =
            mesh.normals.empty() ? surface.flip_normal : normal.dot(Imath::V3d(mesh.normals[mesh.indices[3 * i]])) < 0;
        f(-q.dot(normal) / facing, (facing > 0) != turned);
    }
}

/// The medium at a place as the nearest boundary in a direction tells; nothing if there is none.
std::optional<MediumId> told_at(const SceneDescription& scene, const Vec3& from, const Vec3& along) {
    double nearest = std::numeric_limits<double>::infinity();
    std::optional<MediumId> medium;
    for (const int s : scene.world_surfaces) {
        const Surface& surface = scene.surfaces[static_cast<std::size_t>(s)];
        if (surface.bounds_medium()) {
            for_each_crossing(surface, from, along, [&](double t, bool outwards) {
                if (t > 0 && t < nearest) {
                    nearest = t;
                    medium = outwards ? surface.interior : surface.exterior;
                }
            });
        }
    }
    return medium;
}

/// Directions that are along no face of a model.
std::vector<Vec3> directions() {
    std::vector<Vec3> result;
    for (const Vec3& w : {Vec3(0.36f, 0.48f, 0.8f), Vec3(0.79f, -0.21f, 0.58f), Vec3(-0.17f, 0.91f, -0.38f)}) {
        result.push_back(normalize(w));
        result.push_back(normalize(-w));
    }
    return result;
}

std::optional<MediumFault> fault_of_camera(const SceneDescription& scene) {
    const Vec3 place = scene.camera.middle().origin;
    std::optional<MediumId> told;
    for (const Vec3& w : directions()) {
        const auto medium = told_at(scene, place, w);
        if (!medium || (told && *told != *medium)) {
            return std::nullopt;
        }
        told = medium;
    }
    return *told != scene.camera_medium ? std::optional(MediumFault{MediumFault::Kind::camera, *told, vacuum, -1})
                                        : std::nullopt;
}

/// Whether a closed surface has a place within it.
bool is_within(const Surface& surface, const Vec3& place) {
    int inside = 0;
    const auto ways = directions();
    for (const Vec3& w : ways) {
        int crossed = 0;
        for_each_crossing(surface, place, w,
                          [&](double t, bool outwards) { crossed += t > 0 ? (outwards ? 1 : -1) : 0; });
        inside += crossed > 0 ? 1 : -1;
    }
    return inside == static_cast<int>(ways.size());
}

std::vector<Vec3> some_points(const Surface& surface) {
    std::vector<Vec3> points;
    if (const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get())) {
        const std::size_t step = std::max<std::size_t>(1, mesh->triangle_count() / most_points);
        for (std::size_t i = 0; i < mesh->triangle_count(); i += step) {
            points.push_back((mesh->vertex(i, 0) + mesh->vertex(i, 1) + mesh->vertex(i, 2)) / 3.0f);
        }
        return points;
    }
    const auto& quadric = std::get<Quadric>(*surface.shape);
    for (const Vec3& w : directions()) {
        points.push_back(quadric.world_from_object.point(w * extent(quadric)));
    }
    return points;
}

Box3 box_of(const Surface& surface) {
    return bounds(*surface.shape);
}

/// What is wrong with a surface that meets another one around a different medium.
std::optional<MediumFault> fault_of_pair(const Surface& inner, const Surface& outer) {
    const std::vector<Vec3> points = some_points(inner);
    const auto inside = static_cast<std::size_t>(
        std::count_if(points.begin(), points.end(), [&](const Vec3& p) { return is_within(outer, p); }));
    if (inside == 0) {
        return std::nullopt;
    }
    if (inside < points.size()) {
        return MediumFault{MediumFault::Kind::overlap, inner.interior, outer.interior, -1};
    }
    return inner.exterior == outer.interior
               ? std::nullopt
               : std::optional(MediumFault{MediumFault::Kind::nested, inner.interior, outer.interior, -1});
}

}  // namespace

std::vector<MediumFault> medium_faults(const SceneDescription& scene) {
    std::vector<MediumFault> faults;
    if (const auto fault = fault_of_camera(scene)) {
        faults.push_back(*fault);
    }
    struct Boundary {
        int surface;
        Box3 box;
    };
    std::vector<Boundary> boundaries;
    for (const int s : scene.world_surfaces) {
        const Surface& surface = scene.surfaces[static_cast<std::size_t>(s)];
        if (surface.bounds_medium() && surface.interior != vacuum) {
            boundaries.push_back({s, box_of(surface)});
        }
    }
    // The smaller of two comes first: it is the one that may lie within the other.
    const auto size = [](const Boundary& b) { return length_squared(b.box.size()); };
    std::stable_sort(boundaries.begin(), boundaries.end(),
                     [&](const Boundary& a, const Boundary& b) { return size(a) < size(b); });
    int pairs = 0;
    for (std::size_t i = 0; i < boundaries.size(); ++i) {
        for (std::size_t k = i + 1; k < boundaries.size() && pairs < most_pairs && faults.size() < most_meetings; ++k) {
            const Surface& inner = scene.surfaces[static_cast<std::size_t>(boundaries[i].surface)];
            const Surface& outer = scene.surfaces[static_cast<std::size_t>(boundaries[k].surface)];
            if (inner.interior == outer.interior || !boundaries[i].box.intersects(boundaries[k].box)) {
                continue;
            }
            ++pairs;
            if (auto fault = fault_of_pair(inner, outer)) {
                fault->surface = boundaries[i].surface;
                faults.push_back(*fault);
            }
        }
    }
    return faults;
}

}  // namespace wend
