#include <wend/io/load/subdivision_shapes.h>

#include <wend/io/load/mesh_parameters.h>
#include <wend/io/load/named_value.h>
#include <wend/io/load/subdivision.h>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>
#include <stdexcept>

namespace wend {
namespace {

using Rules = SubdivisionRules;
constexpr std::array<Named<Rules::Scheme>, 3> subdivision_schemes = {{{"catmullClark", Rules::Scheme::catmull_clark},
                                                                      {"loop", Rules::Scheme::loop},
                                                                      {"bilinear", Rules::Scheme::bilinear}}};
constexpr std::array<Named<Rules::Boundary>, 3> boundaries = {{{"none", Rules::Boundary::none},
                                                               {"edgeOnly", Rules::Boundary::edge_only},
                                                               {"edgeAndCorner", Rules::Boundary::edge_and_corner}}};
constexpr std::array<Named<Rules::FaceVarying>, 6> linear_parts = {{{"none", Rules::FaceVarying::none},
                                                                    {"cornersOnly", Rules::FaceVarying::corners_only},
                                                                    {"cornersPlus1", Rules::FaceVarying::corners_plus1},
                                                                    {"cornersPlus2", Rules::FaceVarying::corners_plus2},
                                                                    {"boundaries", Rules::FaceVarying::boundaries},
                                                                    {"all", Rules::FaceVarying::all}}};
constexpr std::array<Named<Rules::Triangles>, 2> triangle_rules = {
    {{"catmullClark", Rules::Triangles::catmull_clark}, {"smooth", Rules::Triangles::smooth}}};

Rules load_rules(const pbrt::ParameterSet& p) {
    const Rules standard;
    Rules rules;
    rules.scheme = named_value(p, "scheme", subdivision_schemes, standard.scheme);
    rules.boundary = named_value(p, "interpolateBoundary", boundaries, standard.boundary);
    rules.face_varying = named_value(p, "faceVaryingLinearInterpolation", linear_parts, standard.face_varying);
    rules.triangles = named_value(p, "triangleSubdivisionRule", triangle_rules, standard.triangles);
    return rules;
}

/// The parameters faceVertexCounts and indices; without the former, triangles for Loop's scheme and quadrangles for
/// others.
void take_control_faces(pbrt::ShapeEntity& shape, Rules::Scheme scheme, ControlMesh& control) {
    pbrt::ParameterSet& p = shape.parameters;
    const pbrt::Location counts_place = p.place_of("faceVertexCounts");
    const pbrt::Location indices_place = p.place_of("indices");
    control.corners = take_indices(shape, "indices", control.positions.size(), "vertices");
    const std::vector<int> counts = p.take_ints("faceVertexCounts");
    std::size_t total = 0;
    for (const int count : counts) {
        if (count < 3) {
            throw InputError(counts_place, fmt::format("a face has {} corners: there must be 3 or more", count));
        }
        control.face_sizes.push_back(static_cast<std::uint32_t>(count));
        total += static_cast<std::size_t>(count);
    }
    if (counts.empty()) {
        const std::size_t corners = scheme == Rules::Scheme::loop ? 3 : 4;
        control.face_sizes.assign(control.corners.size() / corners, static_cast<std::uint32_t>(corners));
        total = control.face_sizes.size() * corners;
    }
    if (total != control.corners.size() || total == 0) {
        throw InputError(indices_place, fmt::format("\"indices\" has {} values, and the faces have {} corners",
                                                    control.corners.size(), total));
    }
}

/// Sharpnesses, none of which is negative or no number.
std::vector<float> take_sharpnesses(pbrt::ParameterSet& p, std::string_view name) {
    const pbrt::Location place = p.place_of(name);
    std::vector<float> values = p.take_numbers(name, pbrt::ParameterType::real);
    for (const float value : values) {
        if (!(value >= 0)) {
            throw InputError(place, fmt::format("\"{}\" has {}: no value must be below 0", name, value));
        }
    }
    return values;
}

/// creaseIndices is one chain of vertices after the other; creaseLengths says how many each has, and creaseSharpnesses
/// has a value a chain or an edge.
void take_creases(pbrt::ShapeEntity& shape, ControlMesh& control) {
    pbrt::ParameterSet& p = shape.parameters;
    const pbrt::Location lengths_place = p.place_of("creaseLengths");
    const pbrt::Location sharpnesses_place = p.place_of("creaseSharpnesses");
    const std::vector<std::uint32_t> indices =
        take_indices(shape, "creaseIndices", control.positions.size(), "vertices");
    const std::vector<int> lengths = p.take_ints("creaseLengths");
    const std::vector<float> sharpnesses = take_sharpnesses(p, "creaseSharpnesses");
    std::size_t total = 0;
    for (const int length : lengths) {
        if (length < 2) {
            throw InputError(lengths_place, fmt::format("a crease has {} vertices: there must be 2 or more", length));
        }
        total += static_cast<std::size_t>(length);
    }
    if (total != indices.size()) {
        throw InputError(
            lengths_place,
            fmt::format("\"creaseLengths\" add up to {}, and \"creaseIndices\" has {} values", total, indices.size()));
    }
    const bool by_chain = sharpnesses.size() == lengths.size();
    if (!by_chain && sharpnesses.size() != total - lengths.size()) {
        throw InputError(sharpnesses_place,
                         fmt::format("\"creaseSharpnesses\" has {} values for {} creases with {} edges",
                                     sharpnesses.size(), lengths.size(), total - lengths.size()));
    }
    std::size_t vertex = 0, edge = 0;
    for (std::size_t chain = 0; chain < lengths.size(); ++chain, ++vertex) {
        for (int i = 1; i < lengths[chain]; ++i, ++vertex, ++edge) {
            control.creases.push_back({indices[vertex], indices[vertex + 1], sharpnesses[by_chain ? chain : edge]});
        }
    }
}

void take_sharp_corners(pbrt::ShapeEntity& shape, ControlMesh& control) {
    const pbrt::Location place = shape.parameters.place_of("cornerSharpnesses");
    const std::vector<std::uint32_t> indices =
        take_indices(shape, "cornerIndices", control.positions.size(), "vertices");
    const std::vector<float> sharpnesses = take_sharpnesses(shape.parameters, "cornerSharpnesses");
    if (sharpnesses.size() != indices.size()) {
        throw InputError(place, fmt::format("\"cornerSharpnesses\" has {} values for {} corners", sharpnesses.size(),
                                            indices.size()));
    }
    for (std::size_t i = 0; i < indices.size(); ++i) {
        control.sharp_corners.push_back({indices[i], sharpnesses[i]});
    }
}

/// The parameters uv and uvindices, which has one for each corner; without it they are one a vertex or one a corner.
void take_uvs(pbrt::ShapeEntity& shape, ControlMesh& control) {
    const pbrt::Location uvs_place = shape.parameters.place_of("uv");
    const pbrt::Location indices_place = shape.parameters.place_of("uvindices");
    control.uvs = take_vectors<Vec2>(shape.parameters, "uv", pbrt::ParameterType::point2);
    control.uv_corners = take_indices(shape, "uvindices", control.uvs.size(), "values of \"uv\"");
    if (control.uvs.empty()) {
        return;
    }
    if (!std::ranges::all_of(control.uvs, [](const Vec2& uv) { return std::isfinite(uv.x) && std::isfinite(uv.y); })) {
        throw InputError(uvs_place, "\"uv\" has a value that is not finite");
    }
    if (control.uv_corners.empty() && control.uvs.size() == control.positions.size()) {
        control.uv_corners = control.corners;
    } else if (control.uv_corners.empty() && control.uvs.size() == control.corners.size()) {
        control.uv_corners.resize(control.corners.size());
        std::iota(control.uv_corners.begin(), control.uv_corners.end(), 0u);
    }
    if (control.uv_corners.size() != control.corners.size()) {
        throw InputError(indices_place, fmt::format("\"uvindices\" has {} values for {} corners of faces",
                                                    control.uv_corners.size(), control.corners.size()));
    }
}

Shape surface_of(LoadContext& context, const pbrt::ShapeEntity& shape, const ControlMesh& control, const Rules& rules) {
    const int levels = shape.parameters.get_int("levels", 3);
    // With what they are made of they take 64 bytes each at most.
    constexpr double most_triangles = 1 << 23;
    context.subdivided += limit_triangles(control, levels);
    if (levels < 0 || !(context.subdivided <= most_triangles)) {
        throw InputError(shape.parameters.place_of("levels"),
                         fmt::format("\"levels\" is {}: it must not be negative, and all surfaces of subdivision "
                                     "together lead to {:.0f} triangles at most",
                                     levels, most_triangles));
    }
    try {
        if (auto limit = limit_surface(control, rules, levels)) {
            return place(shape, *std::move(limit));
        }
    } catch (const std::invalid_argument& fault) {
        throw InputError(shape.place, fault.what());
    }
    throw InputError(shape.place, fmt::format("no face of the \"{}\" has as many different vertices as corners, and is "
                                              "neither a hole nor left out at the boundary",
                                              shape.type));
}

}  // namespace

Shape load_loop_surface(LoadContext& context, pbrt::ShapeEntity& shape) {
    TriangleMeshData faces = take_faces(context, shape, 3);
    ControlMesh control;
    control.positions = std::move(faces.positions);
    control.face_sizes.assign(faces.indices.size() / 3, 3);
    control.corners = std::move(faces.indices);
    Rules rules;
    rules.scheme = Rules::Scheme::loop;
    rules.boundary = Rules::Boundary::edge_only;
    return surface_of(context, shape, control, rules);
}

Shape load_subdivision_surface(LoadContext& context, pbrt::ShapeEntity& shape) {
    const Rules rules = load_rules(shape.parameters);
    ControlMesh control;
    control.positions = take_positions(shape);
    control.end_positions = take_end_positions(shape, control.positions.size());
    take_control_faces(shape, rules.scheme, control);
    control.holes = take_indices(shape, "holeIndices", control.face_sizes.size(), "faces");
    take_creases(shape, control);
    take_sharp_corners(shape, control);
    take_uvs(shape, control);
    return surface_of(context, shape, control, rules);
}

}  // namespace wend
