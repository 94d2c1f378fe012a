#include <wend/io/load/subdivision.h>

#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>

#include <algorithm>
#include <memory>

namespace wend {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// A sum of weighted points, as OpenSubdiv forms it.
struct PointSum {
    Vec3 point{0, 0, 0};

    void Clear() { point = {0, 0, 0}; }
    void AddWithWeight(const PointSum& other, float weight) { point += other.point * weight; }
};

/// The control mesh; none if it has no triangle.
std::unique_ptr<Far::TopologyRefiner> connect(std::size_t vertices, std::span<const std::uint32_t> indices) {
    std::vector<Far::Index> corners;
    for (std::size_t i = 0; i + 2 < indices.size(); i += 3) {
        const std::uint32_t a = indices[i], b = indices[i + 1], c = indices[i + 2];
        if (a != b && b != c && c != a) {
            for (const std::uint32_t corner : {a, b, c}) {
                corners.push_back(static_cast<Far::Index>(corner));
            }
        }
    }
    if (corners.empty()) {
        return nullptr;
    }
    const std::vector<int> corners_of_faces(corners.size() / 3, 3);
    Far::TopologyDescriptor mesh;
    mesh.numVertices = static_cast<int>(vertices);
    mesh.numFaces = static_cast<int>(corners_of_faces.size());
    mesh.numVertsPerFace = corners_of_faces.data();
    mesh.vertIndicesPerFace = corners.data();
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
    using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
    return std::unique_ptr<Far::TopologyRefiner>(Factory::Create(mesh, Factory::Options(Sdc::SCHEME_LOOP, options)));
}

std::vector<Vec3> points_of(const std::vector<PointSum>& sums) {
    std::vector<Vec3> points(sums.size());
    std::ranges::transform(sums, points.begin(), &PointSum::point);
    return points;
}

}  // namespace

std::optional<TriangleMeshData> subdivide(std::span<const Vec3> positions, std::span<const std::uint32_t> indices,
                                          int levels) {
    const std::unique_ptr<Far::TopologyRefiner> refiner = connect(positions.size(), indices);
    if (!refiner) {
        return std::nullopt;
    }
    Far::TopologyRefiner::UniformOptions uniform(levels);
    uniform.fullTopologyInLastLevel = true;
    refiner->RefineUniform(uniform);

    std::vector<PointSum> points(positions.size());
    std::ranges::transform(positions, points.begin(), [](const Vec3& p) { return PointSum{p}; });
    const Far::PrimvarRefiner refine(*refiner);
    for (int level = 1; level <= levels; ++level) {
        std::vector<PointSum> finer(static_cast<std::size_t>(refiner->GetLevel(level).GetNumVertices()));
        refine.Interpolate(level, points, finer);
        points = std::move(finer);
    }
    std::vector<PointSum> limits(points.size());
    std::vector<PointSum> along(points.size());
    std::vector<PointSum> across(points.size());
    refine.Limit(points, limits, along, across);

    TriangleMeshData mesh;
    mesh.positions = points_of(limits);
    mesh.normals.resize(limits.size());
    for (std::size_t i = 0; i < limits.size(); ++i) {
        mesh.normals[i] = cross(along[i].point, across[i].point);
    }
    const Far::TopologyLevel finest = refiner->GetLevel(levels);
    mesh.indices.reserve(3 * static_cast<std::size_t>(finest.GetNumFaces()));
    for (int face = 0; face < finest.GetNumFaces(); ++face) {
        for (const Far::Index vertex : finest.GetFaceVertices(face)) {
            mesh.indices.push_back(static_cast<std::uint32_t>(vertex));
        }
    }
    return mesh;
}

}  // namespace wend
