#include <wend/io/load/subdivision.h>

#include <wend/io/load/subdivision_topology.h>

#include <opensubdiv/bfr/refinerSurfaceFactory.h>
#include <opensubdiv/bfr/surface.h>
#include <opensubdiv/bfr/tessellation.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <numeric>
#include <span>
#include <utility>

namespace wend {
namespace {

namespace Bfr = OpenSubdiv::Bfr;
namespace Far = OpenSubdiv::Far;

/// How a face of some size is cut. Points of its boundary come first: each vertex, then the edge that begins there.
struct Pattern {
    std::vector<float> coordinates;  ///< two a point
    std::vector<int> triangles;
    int boundary_points;

    Pattern(const Bfr::Parameterization& face, int rate) {
        const Bfr::Tessellation cut(face, rate);
        coordinates.resize(2 * static_cast<std::size_t>(cut.GetNumCoords()));
        cut.GetCoords(coordinates.data());
        triangles.resize(3 * static_cast<std::size_t>(cut.GetNumFacets()));
        cut.GetFacets(triangles.data());
        boundary_points = cut.GetNumBoundaryCoords();
    }

    std::size_t size() const { return coordinates.size() / 2; }
};

/// What a face has where it is cut.
struct Sample {
    Vec3 position, normal;
    Vec3 end_position, end_normal;  ///< of what moves
    Vec2 uv;
};

/// The triangles of all faces. What is on an edge is at one place for all faces that meet there, and also one vertex
/// unless normals or texture coordinates differ.
class LimitMesh {
public:
    LimitMesh(const Far::TopologyLevel& control, int rate, bool has_uvs, bool is_moving)
        : control_(control),
          rate_(rate),
          has_uvs_(has_uvs),
          is_moving_(is_moving),
          point_of_vertex_(static_cast<std::size_t>(control.GetNumVertices()), none),
          points_of_edge_(static_cast<std::size_t>(control.GetNumEdges()), none) {}

    void add_face(int face, const Pattern& pattern, std::span<const Sample> samples) {
        number_points(face, pattern);
        vertices_.clear();
        for (std::size_t i = 0; i < samples.size(); ++i) {
            vertices_.push_back(vertex_at(points_[i], samples[i]));
        }
        for (const int corner : pattern.triangles) {
            mesh_.indices.push_back(vertices_[static_cast<std::size_t>(corner)]);
        }
    }

    TriangleMeshData take() { return std::move(mesh_); }

private:
    static constexpr std::uint32_t none = ~0u;

    std::uint32_t new_points(int count) {
        const auto first = static_cast<std::uint32_t>(first_vertex_.size());
        first_vertex_.resize(first_vertex_.size() + static_cast<std::size_t>(count), none);
        return first;
    }

    /// Fills points_: the place of each point of the pattern, by number.
    void number_points(int face, const Pattern& pattern) {
        points_.clear();
        const Far::ConstIndexArray vertices = control_.GetFaceVertices(face);
        const Far::ConstIndexArray edges = control_.GetFaceEdges(face);
        const auto on_edge = static_cast<std::uint32_t>(rate_ - 1);
        for (int i = 0; i < vertices.size(); ++i) {
            std::uint32_t& vertex = point_of_vertex_[static_cast<std::size_t>(vertices[i])];
            vertex = vertex == none ? new_points(1) : vertex;
            points_.push_back(vertex);
            std::uint32_t& edge = points_of_edge_[static_cast<std::size_t>(edges[i])];
            edge = edge == none && on_edge > 0 ? new_points(rate_ - 1) : edge;
            const bool runs_along = control_.GetEdgeVertices(edges[i])[0] == vertices[i];
            for (std::uint32_t k = 0; k < on_edge; ++k) {
                points_.push_back(edge + (runs_along ? k : on_edge - 1 - k));
            }
        }
        const int inner = static_cast<int>(pattern.size()) - pattern.boundary_points;
        const std::uint32_t first = new_points(inner);
        for (int i = 0; i < inner; ++i) {
            points_.push_back(first + static_cast<std::uint32_t>(i));
        }
    }

    std::uint32_t vertex_at(std::uint32_t point, const Sample& sample) {
        std::uint32_t* next = &first_vertex_[point];
        while (*next != none && !is_alike(*next, sample)) {
            next = &next_vertex_[*next];
        }
        if (*next != none) {
            return *next;
        }
        const auto vertex = static_cast<std::uint32_t>(mesh_.positions.size());
        *next = vertex;
        const std::uint32_t first = first_vertex_[point];
        mesh_.positions.push_back(first == vertex ? sample.position : Vec3(mesh_.positions[first]));
        mesh_.normals.push_back(sample.normal);
        if (is_moving_) {
            mesh_.end_positions.push_back(first == vertex ? sample.end_position : Vec3(mesh_.end_positions[first]));
            mesh_.end_normals.push_back(sample.end_normal);
        }
        if (has_uvs_) {
            mesh_.uvs.push_back(sample.uv);
        }
        next_vertex_.push_back(none);
        return vertex;
    }

    /// Up to what the two sides of an edge may differ by as they are evaluated.
    bool is_alike(std::uint32_t vertex, const Sample& sample) const {
        constexpr float tolerance = 1e-5f;
        if (!is_one_way(mesh_.normals[vertex], sample.normal) ||
            (is_moving_ && !is_one_way(mesh_.end_normals[vertex], sample.end_normal))) {
            return false;
        }
        return !has_uvs_ || (mesh_.uvs[vertex] - sample.uv).length() <= tolerance * std::max(1.0f, sample.uv.length());
    }

    static bool is_one_way(const Vec3& a, const Vec3& b) {
        constexpr float cosine = 1 - 4e-5f;
        return dot(a, b) >= cosine || (a == Vec3(0, 0, 0) && b == a);
    }

    const Far::TopologyLevel& control_;
    int rate_;
    bool has_uvs_, is_moving_;
    std::vector<std::uint32_t> point_of_vertex_, points_of_edge_;
    std::vector<std::uint32_t> first_vertex_;       ///< at each point
    std::vector<std::uint32_t> next_vertex_;        ///< in the same place
    std::vector<std::uint32_t> points_, vertices_;  ///< of the face that is added
    TriangleMeshData mesh_;
};

/// Evaluates one face after the other.
class FaceSampler {
public:
    FaceSampler(const ControlMesh& control, const Far::TopologyRefiner& refiner, int levels)
        : control_(control), refiner_(refiner), options_(options(levels)) {}

    /// None where there is no surface. Faces must be asked for in their order.
    std::optional<Bfr::Parameterization> begin(int face) {
        // It keeps what it has made for one face, some 100 KB where creases are soft, for others like it.
        constexpr int most_kept = 512;
        if (face % most_kept == 0) {
            factory_.emplace(refiner_, options_);
        }
        const bool is_there = control_.uvs.empty() ? factory_->InitVertexSurface(face, &surface_)
                                                   : factory_->InitSurfaces(face, &surface_, &uv_surface_, nullptr, 1);
        if (!is_there) {
            return std::nullopt;
        }
        prepare(surface_, &control_.positions.data()->x, 3, patch_);
        if (!control_.end_positions.empty()) {
            prepare(surface_, &control_.end_positions.data()->x, 3, end_patch_);
        }
        if (!control_.uvs.empty()) {
            prepare(uv_surface_, &control_.uvs.data()->x, 2, uv_patch_);
        }
        return surface_.GetParameterization();
    }

    const std::vector<Sample>& sample(const Pattern& pattern) {
        samples_.resize(pattern.size());
        for (std::size_t i = 0; i < samples_.size(); ++i) {
            const float* const uv = &pattern.coordinates[2 * i];
            Sample& sample = samples_[i];
            sample.normal = point_at(uv, patch_, sample.position);
            if (!control_.end_positions.empty()) {
                sample.end_normal = point_at(uv, end_patch_, sample.end_position);
            }
            if (!control_.uvs.empty()) {
                uv_surface_.Evaluate(uv, uv_patch_.data(), 2, &sample.uv.x);
            }
        }
        return samples_;
    }

private:
    using Factory = Bfr::RefinerSurfaceFactory<>;

    static Factory::Options options(int levels) {
        // Where a vertex has another number of edges than regular meshes have, the surface is known exactly at the
        // points of this many levels, and between them by smooth patches.
        constexpr int fewest = 2, most = 5;
        return Factory::Options().SetApproxLevelSmooth(std::clamp(levels, fewest, most));
    }

    static void prepare(const Bfr::Surface<float>& surface, const float* values, int width, std::vector<float>& patch) {
        patch.resize(static_cast<std::size_t>(surface.GetNumPatchPoints() * width));
        surface.PreparePatchPoints(values, width, patch.data(), width);
    }

    /// Fills in the place; returns the normal, zero where there is none.
    Vec3 point_at(const float* uv, const std::vector<float>& patch, Vec3& position) const {
        Vec3 normal = evaluate(uv, patch, position);
        if (normal == Vec3(0, 0, 0)) {
            // Where a boundary runs smoothly through the corner of a face, both ways along it are the same.
            float beside[2];
            move_inwards(uv, beside);
            Vec3 elsewhere;
            normal = evaluate(beside, patch, elsewhere);
        }
        return normal;
    }

    /// The same without a second look.
    Vec3 evaluate(const float* uv, const std::vector<float>& patch, Vec3& position) const {
        Vec3 du, dv;
        surface_.Evaluate(uv, patch.data(), 3, &position.x, &du.x, &dv.x);
        const Vec3 normal = cross(du, dv);
        constexpr float smallest_sine = 1e-4f;
        const bool has_normal =
            is_finite(normal) && length_squared(normal) > sqr(smallest_sine) * length_squared(du) * length_squared(dv);
        return has_normal ? normalize(normal) : Vec3(0, 0, 0);
    }

    /// A little towards the middle of the face.
    void move_inwards(const float* from, float* to) const {
        constexpr float part = 0.01f;
        const Bfr::Parameterization face = surface_.GetParameterization();
        float within[2] = {from[0], from[1]}, middle[2] = {0.5f, 0.5f};
        const int tile = face.HasSubFaces() ? face.ConvertCoordToSubFace(from, within) : 0;
        if (!face.HasSubFaces()) {
            face.GetCenterCoord(middle);
        }
        for (int k = 0; k < 2; ++k) {
            to[k] = within[k] + part * (middle[k] - within[k]);
        }
        if (face.HasSubFaces()) {
            std::copy(to, to + 2, within);
            face.ConvertSubFaceToCoord(tile, within, to);
        }
    }

    const ControlMesh& control_;
    const Far::TopologyRefiner& refiner_;
    Factory::Options options_;
    std::optional<Factory> factory_;
    Bfr::Surface<float> surface_, uv_surface_;
    std::vector<float> patch_, end_patch_, uv_patch_;
    std::vector<Sample> samples_;
};

}  // namespace

std::optional<TriangleMeshData> limit_surface(const ControlMesh& control, const SubdivisionRules& rules, int levels) {
    const std::unique_ptr<Far::TopologyRefiner> refiner = connect(control, rules);
    if (!refiner) {
        return std::nullopt;
    }
    const Far::TopologyLevel level = refiner->GetLevel(0);
    const int rate = 1 << levels;
    FaceSampler sampler(control, *refiner, levels);
    LimitMesh mesh(level, rate, !control.uvs.empty(), !control.end_positions.empty());
    std::map<int, Pattern> patterns;
    for (int face = 0; face < level.GetNumFaces(); ++face) {
        if (const auto parameterization = sampler.begin(face)) {
            const Pattern& pattern =
                patterns.try_emplace(parameterization->GetFaceSize(), *parameterization, rate).first->second;
            mesh.add_face(face, pattern, sampler.sample(pattern));
        }
    }
    TriangleMeshData limit = mesh.take();
    return limit.indices.empty() ? std::nullopt : std::optional(std::move(limit));
}

double limit_triangles(const ControlMesh& control, int levels) {
    std::vector<std::uint32_t> sizes = control.face_sizes;
    for (const std::uint32_t hole : control.holes) {
        sizes[hole] = 0;
    }
    // Of edges cut into r pieces, a quadrangle becomes 2 r², a corner of a larger face r² / 2; that itself a fan.
    return std::accumulate(sizes.begin(), sizes.end(), 0.0) * std::max(std::pow(4.0, levels) / 2, 1.0);
}

}  // namespace wend
