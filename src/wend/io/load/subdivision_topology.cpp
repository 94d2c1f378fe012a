#include <wend/io/load/subdivision_topology.h>

#include <opensubdiv/far/topologyDescriptor.h>

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <utility>

namespace wend {
namespace {

namespace Far = OpenSubdiv::Far;
namespace Sdc = OpenSubdiv::Sdc;

/// Corners of a face, and edges of a vertex: what OpenSubdiv does for it grows with the third power.
constexpr int most_around = 128;

Sdc::SchemeType scheme_of(SubdivisionRules::Scheme scheme) {
    switch (scheme) {
        case SubdivisionRules::Scheme::loop:
            return Sdc::SCHEME_LOOP;
        case SubdivisionRules::Scheme::bilinear:
            return Sdc::SCHEME_BILINEAR;
        case SubdivisionRules::Scheme::catmull_clark:
            break;
    }
    return Sdc::SCHEME_CATMARK;
}

Sdc::Options options_of(const SubdivisionRules& rules) {
    using enum Sdc::Options::FVarLinearInterpolation;
    static constexpr Sdc::Options::VtxBoundaryInterpolation vertex_boundaries[] = {
        Sdc::Options::VTX_BOUNDARY_NONE, Sdc::Options::VTX_BOUNDARY_EDGE_ONLY,
        Sdc::Options::VTX_BOUNDARY_EDGE_AND_CORNER};
    static constexpr Sdc::Options::FVarLinearInterpolation linear[] = {
        FVAR_LINEAR_NONE,          FVAR_LINEAR_CORNERS_ONLY, FVAR_LINEAR_CORNERS_PLUS1,
        FVAR_LINEAR_CORNERS_PLUS2, FVAR_LINEAR_BOUNDARIES,   FVAR_LINEAR_ALL};
    Sdc::Options options;
    options.SetVtxBoundaryInterpolation(vertex_boundaries[static_cast<std::size_t>(rules.boundary)]);
    options.SetFVarLinearInterpolation(linear[static_cast<std::size_t>(rules.face_varying)]);
    options.SetTriangleSubdivision(rules.triangles == SubdivisionRules::Triangles::smooth
                                       ? Sdc::Options::TRI_SUB_SMOOTH
                                       : Sdc::Options::TRI_SUB_CATMARK);
    return options;
}

/// A control mesh in the terms of OpenSubdiv, without faces that have a vertex twice.
class Topology {
public:
    Topology(const ControlMesh& control, const SubdivisionRules& rules) : control_(control), rules_(rules) {
        std::vector<Far::Index> new_number(control.face_sizes.size(), -1);
        std::size_t first = 0;
        for (std::size_t face = 0; face < control.face_sizes.size(); ++face) {
            const std::size_t size = control.face_sizes[face];
            require_size(face, size);
            if (is_simple({control.corners.data() + first, size})) {
                new_number[face] = static_cast<Far::Index>(sizes_.size());
                add_face(first, size);
            }
            first += size;
        }
        find_edges();
        for (const std::uint32_t hole : control.holes) {
            if (new_number[hole] >= 0) {
                holes_.push_back(new_number[hole]);
            }
        }
        add_creases();
        for (const ControlMesh::Corner& corner : control.sharp_corners) {
            sharp_corners_.push_back(static_cast<Far::Index>(corner.vertex));
            corner_weights_.push_back(corner.sharpness);
        }
    }

    /// None if there is no face.
    std::unique_ptr<Far::TopologyRefiner> connect() const {
        if (sizes_.empty()) {
            return nullptr;
        }
        Far::TopologyDescriptor mesh;
        mesh.numVertices = static_cast<int>(control_.positions.size());
        mesh.numFaces = static_cast<int>(sizes_.size());
        mesh.numVertsPerFace = sizes_.data();
        mesh.vertIndicesPerFace = corners_.data();
        mesh.numHoles = static_cast<int>(holes_.size());
        mesh.holeIndices = holes_.data();
        mesh.numCreases = static_cast<int>(crease_weights_.size());
        mesh.creaseVertexIndexPairs = crease_ends_.data();
        mesh.creaseWeights = crease_weights_.data();
        mesh.numCorners = static_cast<int>(corner_weights_.size());
        mesh.cornerVertexIndices = sharp_corners_.data();
        mesh.cornerWeights = corner_weights_.data();
        Far::TopologyDescriptor::FVarChannel uvs;
        uvs.numValues = static_cast<int>(control_.uvs.size());
        uvs.valueIndices = uv_corners_.data();
        mesh.numFVarChannels = control_.uvs.empty() ? 0 : 1;
        mesh.fvarChannels = &uvs;
        using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
        return std::unique_ptr<Far::TopologyRefiner>(
            Factory::Create(mesh, Factory::Options(scheme_of(rules_.scheme), options_of(rules_))));
    }

private:
    using Edge = std::pair<Far::Index, Far::Index>;

    void require_size(std::size_t face, std::size_t size) const {
        if (size < 3 || size > most_around) {
            throw std::invalid_argument(
                fmt::format("face {} has {} corners; faces have 3 to {} of them", face, size, most_around));
        }
        if (rules_.scheme == SubdivisionRules::Scheme::loop && size != 3) {
            throw std::invalid_argument(
                fmt::format("face {} has {} corners; the scheme \"loop\" takes triangles alone", face, size));
        }
    }

    static bool is_simple(std::span<const std::uint32_t> corners) {
        std::vector<std::uint32_t> sorted(corners.begin(), corners.end());
        std::ranges::sort(sorted);
        return std::ranges::adjacent_find(sorted) == sorted.end();
    }

    void add_face(std::size_t first, std::size_t size) {
        sizes_.push_back(static_cast<int>(size));
        for (std::size_t i = first; i < first + size; ++i) {
            corners_.push_back(static_cast<Far::Index>(control_.corners[i]));
            if (!control_.uvs.empty()) {
                uv_corners_.push_back(static_cast<Far::Index>(control_.uv_corners[i]));
            }
        }
    }

    void find_edges() {
        std::size_t first = 0;
        for (const int size : sizes_) {
            const auto n = static_cast<std::size_t>(size);
            for (std::size_t i = 0; i < n; ++i) {
                edges_.push_back(std::minmax({corners_[first + i], corners_[first + (i + 1) % n]}));
            }
            first += n;
        }
        std::ranges::sort(edges_);
        edges_.erase(std::unique(edges_.begin(), edges_.end()), edges_.end());
        std::vector<int> edges_of(control_.positions.size(), 0);
        for (const auto& [from, to] : edges_) {
            for (const Far::Index vertex : {from, to}) {
                if (++edges_of[static_cast<std::size_t>(vertex)] > most_around) {
                    throw std::invalid_argument(fmt::format("vertex {} has more than {} edges", vertex, most_around));
                }
            }
        }
    }

    /// OpenSubdiv complains, on the standard output, of creases along what is no edge.
    void add_creases() {
        for (const ControlMesh::Crease& crease : control_.creases) {
            const Edge edge = std::minmax({static_cast<Far::Index>(crease.from), static_cast<Far::Index>(crease.to)});
            if (std::ranges::binary_search(edges_, edge)) {
                crease_ends_.insert(crease_ends_.end(), {edge.first, edge.second});
                crease_weights_.push_back(crease.sharpness);
            }
        }
    }

    const ControlMesh& control_;
    const SubdivisionRules& rules_;
    std::vector<int> sizes_;
    std::vector<Edge> edges_;
    std::vector<Far::Index> corners_, uv_corners_, holes_, crease_ends_, sharp_corners_;
    std::vector<float> crease_weights_, corner_weights_;
};

}  // namespace

std::unique_ptr<Far::TopologyRefiner> connect(const ControlMesh& control, const SubdivisionRules& rules) {
    return Topology(control, rules).connect();
}

}  // namespace wend
