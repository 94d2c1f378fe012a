#include <wend/scene/boundary_faults.h>

#include <wend/scene/loose_edges.h>

#include <algorithm>
#include <cmath>
#include <numeric>

namespace wend {
namespace {

constexpr int whole_world = -1;
/// Holes that are looked at in one medium, and points of each.
constexpr std::size_t most_holes = 16;
constexpr std::size_t points_of_hole = 16;
/// What covers less of its outline's length, squared, is no hole but a seam.
constexpr double seam = 1e-4;
/// What is a smaller share of all the boundary is no hole but a pole that a modeller left out.
constexpr double pinhole_share = 1e-6;
/// Of one medium.
constexpr std::size_t most_faults = 16;

const std::vector<int>& surfaces_of(const SceneDescription& scene, int object) {
    return object == whole_world ? scene.world_surfaces : scene.objects[static_cast<std::size_t>(object)].surfaces;
}

bool is_passable(const SceneDescription& scene, const Surface& surface) {
    const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
    const auto* principled = std::get_if<PrincipledMaterial>(&material);
    const auto* disney = std::get_if<DisneyMaterial>(&material);
    return (principled && principled->subsurface >= 0) || (disney && disney->transmits) ||
           std::holds_alternative<InterfaceMaterial>(material) ||
           std::holds_alternative<DielectricMaterial>(material) ||
           std::holds_alternative<ThinDielectricMaterial>(material) ||
           std::holds_alternative<DisneySheetMaterial>(material) ||
           std::holds_alternative<DiffuseTransmissionMaterial>(material) ||
           std::holds_alternative<MixMaterial>(material) || surface.alpha >= 0;
}

/// All that bounds one medium.
struct Boundary {
    std::vector<int> surfaces;
    int object = whole_world;  ///< where all of it is
    bool is_interior = false;  ///< of any surface that lets light in
    bool is_decidable = true;
};

std::vector<Boundary> boundaries(const SceneDescription& scene) {
    std::vector<Boundary> result(scene.media.size());
    const auto add = [&](int object) {
        for (const int s : surfaces_of(scene, object)) {
            const Surface& surface = scene.surfaces[static_cast<std::size_t>(s)];
            if (!surface.bounds_medium()) {
                continue;
            }
            for (const MediumId medium : {surface.interior, surface.exterior}) {
                if (medium == vacuum) {
                    continue;
                }
                Boundary& b = result[static_cast<std::size_t>(medium)];
                const auto* quadric = std::get_if<Quadric>(surface.shape.get());
                const auto* sphere = quadric ? std::get_if<Sphere>(&quadric->shape) : nullptr;
                b.is_decidable = b.is_decidable && (b.surfaces.empty() || b.object == object) &&
                                 (!quadric || (sphere && sphere->is_full()));
                b.is_interior = b.is_interior || (medium == surface.interior && is_passable(scene, surface));
                b.object = object;
                b.surfaces.push_back(s);
            }
        }
    };
    add(whole_world);
    for (std::size_t i = 0; i < scene.objects.size(); ++i) {
        add(static_cast<int>(i));
    }
    return result;
}

/// A group of loose edges that hang together.
struct Hole {
    std::vector<const LooseEdge*> ends;  ///< edges of a single triangle, through whose surface light can pass
    Imath::V3d area{0, 0, 0};            ///< of a surface that would close it, as a vector
    double length = 0;                   ///< of its outline
};

class Judge {
public:
    Judge(const SceneDescription& scene, MediumId medium, const Boundary& boundary)
        : scene_(scene), medium_(medium), boundary_(boundary) {
        for (const int s : boundary.surfaces) {
            const Surface& surface = scene.surfaces[static_cast<std::size_t>(s)];
            if (const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get())) {
                const bool turned = mesh->normals.empty() && surface.flip_normal;
                meshes_.push_back({mesh, turned != (surface.interior != medium)});
                surface_of_mesh_.push_back(s);
            }
        }
    }

    std::vector<BoundaryFault> run() {
        const auto edges = loose_edges(meshes_);
        if (!edges) {
            return {};
        }
        for (const LooseEdge& edge : *edges) {
            if (edge.uses == 2 && edge.surplus == 2 && is_passable(scene_, surface_of(edge))) {
                report(BoundaryFault::Kind::contrary, edge);
            }
        }
        std::size_t looked_at = 0;
        const double least_area = edges->empty() ? 0 : pinhole_share * area();
        for (const Hole& hole : holes(*edges)) {
            const bool is_wide = hole.area.length() > std::max(seam * hole.length * hole.length, least_area);
            if (!hole.ends.empty() && is_wide && looked_at++ < most_holes && !may_be_closed(hole)) {
                for (const LooseEdge* edge : hole.ends) {
                    report(BoundaryFault::Kind::open, *edge);
                }
            }
        }
        if (edges->empty() && medium_ != scene_.camera_medium && volume() < 0) {
            faults_.push_back({BoundaryFault::Kind::inside_out, medium_, boundary_.surfaces.front()});
        }
        return faults_;
    }

private:
    const Surface& surface_of(const LooseEdge& edge) const {
        return scene_.surfaces[static_cast<std::size_t>(surface_of_mesh_[edge.mesh])];
    }

    void report(BoundaryFault::Kind kind, const LooseEdge& edge) {
        const int surface = surface_of_mesh_[edge.mesh];
        const auto same = [&](const BoundaryFault& f) { return f.kind == kind && f.surface == surface; };
        auto fault = std::find_if(faults_.begin(), faults_.end(), same);
        if (fault == faults_.end()) {
            if (faults_.size() == most_faults) {
                return;
            }
            fault = faults_.insert(fault, {kind, medium_, surface, 0, (edge.from + edge.to) * 0.5f});
        }
        ++fault->edges;
    }

    /// The edges by what hangs together. Each group is a closed outline, or the two sides of a seam.
    std::vector<Hole> holes(const std::vector<LooseEdge>& edges) const {
        std::uint32_t points = 0;
        for (const LooseEdge& edge : edges) {
            points = std::max({points, edge.ends[0] + 1, edge.ends[1] + 1});
        }
        std::vector<std::uint32_t> parent(points);
        std::iota(parent.begin(), parent.end(), 0u);
        const auto root = [&](std::uint32_t i) {
            for (; parent[i] != i; i = parent[i]) {
                parent[i] = parent[parent[i]];
            }
            return i;
        };
        for (const LooseEdge& edge : edges) {
            parent[root(edge.ends[0])] = root(edge.ends[1]);
        }
        std::vector<std::size_t> index(points, edges.size());
        std::vector<Hole> result;
        std::vector<Imath::V3d> origins;
        for (const LooseEdge& edge : edges) {
            std::size_t& i = index[root(edge.ends[0])];
            if (i == edges.size()) {
                i = result.size();
                result.emplace_back();
                origins.emplace_back(edge.from);
            }
            Hole& hole = result[i];
            const Imath::V3d from = Imath::V3d(edge.from) - origins[i];
            const Imath::V3d to = Imath::V3d(edge.to) - origins[i];
            hole.area += from.cross(to) * (0.5 * edge.surplus);
            hole.length += (to - from).length();
            if (edge.uses == 1 && is_passable(scene_, surface_of(edge))) {
                hole.ends.push_back(&edge);
            }
        }
        return result;
    }

    /// Whether opaque surfaces are near enough all around.
    bool may_be_closed(const Hole& hole) const {
        const float margin = 0.02f * static_cast<float>(std::sqrt(hole.area.length()));
        std::vector<Vec3> points;
        for (std::size_t i = 0; i < std::min(points_of_hole, hole.ends.size()); ++i) {
            const LooseEdge& edge = *hole.ends[i * hole.ends.size() / std::min(points_of_hole, hole.ends.size())];
            points.push_back((edge.from + edge.to) * 0.5f);
        }
        remove_near(surfaces_of(scene_, boundary_.object), margin, points);
        if (boundary_.object != whole_world) {
            const auto is_here = [&](const Instance& i) { return i.object == boundary_.object; };
            const auto instance = std::find_if(scene_.instances.begin(), scene_.instances.end(), is_here);
            if (instance == scene_.instances.end()) {
                return true;
            }
            for (Vec3& p : points) {
                p = instance->world_from_object.start().point(p);
            }
            const double scale = std::cbrt(std::abs(instance->world_from_object.start().determinant()));
            remove_near(scene_.world_surfaces, margin * static_cast<float>(scale), points);
        }
        return points.empty();
    }

    /// Removes the points within the bounds of any opaque triangle or quadric, widened by a margin.
    void remove_near(const std::vector<int>& surfaces, float margin, std::vector<Vec3>& points) const {
        const auto remove = [&](Box3 box) {
            box.min -= Vec3(margin);
            box.max += Vec3(margin);
            std::erase_if(points, [&](const Vec3& p) { return box.intersects(p); });
        };
        for (const int s : surfaces) {
            const Surface& surface = scene_.surfaces[static_cast<std::size_t>(s)];
            if (is_passable(scene_, surface)) {
                continue;
            }
            if (const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get())) {
                for (std::size_t i = 0; i < mesh->triangle_count() && !points.empty(); ++i) {
                    Box3 box(mesh->vertex(i, 0));
                    box.extendBy(mesh->vertex(i, 1));
                    box.extendBy(mesh->vertex(i, 2));
                    remove(box);
                }
            } else {
                remove(bounds(*surface.shape));
            }
        }
    }

    /// Of all meshes.
    double area() const {
        double sum = 0;
        for (const OrientedMesh& mesh : meshes_) {
            for (std::size_t i = 0; i < mesh.mesh->triangle_count(); ++i) {
                const std::array<Vec3, 3> p = mesh.triangle(i);
                sum += 0.5 * static_cast<double>(length(cross(p[1] - p[0], p[2] - p[0])));
            }
        }
        return sum;
    }

    /// Of the medium within its boundary, which is closed; negative if the medium is outside.
    double volume() const {
        double sum = 0;
        const Imath::V3d origin(meshes_.empty() ? Vec3(0) : meshes_[0].mesh->positions[0]);
        for (const OrientedMesh& mesh : meshes_) {
            for (std::size_t i = 0; i < mesh.mesh->triangle_count(); ++i) {
                const std::array<Vec3, 3> p = mesh.triangle(i);
                const Imath::V3d a = Imath::V3d(p[0]) - origin;
                sum += a.dot((Imath::V3d(p[1]) - origin).cross(Imath::V3d(p[2]) - origin)) / 6;
            }
        }
        for (const int s : boundary_.surfaces) {
            const Surface& surface = scene_.surfaces[static_cast<std::size_t>(s)];
            if (const auto* quadric = std::get_if<Quadric>(surface.shape.get())) {
                const auto axis = [&](const Vec3& v) { return quadric->world_from_object.vector(v); };
                const float scale = std::abs(dot(axis({1, 0, 0}), cross(axis({0, 1, 0}), axis({0, 0, 1}))));
                const double radius = std::get<Sphere>(quadric->shape).radius;
                const bool is_inside = (surface.interior == medium_) != surface.flip_normal;
                sum += (is_inside ? 1 : -1) * 4.0 / 3 * static_cast<double>(pi) * radius * radius * radius *
                       static_cast<double>(scale);
            }
        }
        return sum;
    }

    const SceneDescription& scene_;
    MediumId medium_;
    const Boundary& boundary_;
    std::vector<OrientedMesh> meshes_;
    std::vector<int> surface_of_mesh_;
    std::vector<BoundaryFault> faults_;
};

}  // namespace

std::vector<BoundaryFault> boundary_faults(const SceneDescription& scene) {
    std::vector<BoundaryFault> faults;
    const std::vector<Boundary> all = boundaries(scene);
    for (std::size_t m = 0; m < all.size(); ++m) {
        if (all[m].is_interior && all[m].is_decidable && std::holds_alternative<HomogeneousMedium>(scene.media[m])) {
            const auto found = Judge(scene, static_cast<MediumId>(m), all[m]).run();
            faults.insert(faults.end(), found.begin(), found.end());
        }
    }
    return faults;
}

}  // namespace wend
