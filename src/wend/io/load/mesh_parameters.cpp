#include <wend/io/load/mesh_parameters.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace wend {
namespace {

template <class Vector>
void require_one_a_vertex(LoadContext& context, const pbrt::ShapeEntity& shape, std::vector<Vector>& values,
                          std::size_t vertices, std::string_view name) {
    if (!values.empty() && values.size() != vertices) {
        context.warnings.add(shape.parameters.place_of(name),
                             fmt::format("\"{}\" has not one value a vertex and is ignored", name));
        values.clear();
    }
}

/// To the world; returns the lengths of the shortest and of the longest. A normal that is no direction becomes zero,
/// which leaves its part of the surface flat.
std::pair<float, float> place_normals(const pbrt::ShapeEntity& shape, std::vector<Vec3>& normals) {
    float shortest = infinity, longest = 0;
    for (Vec3& n : normals) {
        const Vec3 mapped = shape.world_from_object.normal(n) * (shape.reverse_orientation ? -1.0f : 1.0f);
        const float size = is_finite(mapped) ? length(mapped) : 0.0f;
        n = size > 0 && std::isfinite(size) ? mapped : Vec3(0, 0, 0);
        if (n != Vec3(0, 0, 0)) {
            shortest = std::min(shortest, size);
            longest = std::max(longest, size);
        }
    }
    return {shortest, longest};
}

/// To the world, at both ends of a motion. Normals of unequal length keep their ratios: the longer one counts more
/// between them, as in pbrt, though no more than a million times.
void place_normals(const pbrt::ShapeEntity& shape, TriangleMesh& mesh) {
    constexpr float equal = 0.999f, least = 1e-6f;
    const auto [shortest, longest] = place_normals(shape, mesh.normals);
    const auto [shortest_end, longest_end] = place_normals(shape, mesh.end_normals);
    const bool are_even = shortest > equal * longest && shortest_end > equal * longest_end;
    const float unit = std::max(longest, longest_end);
    for (auto* const normals : {&mesh.normals, &mesh.end_normals}) {
        for (Vec3& n : *normals) {
            if (n != Vec3(0, 0, 0)) {
                n = normalize(n) * (are_even ? 1.0f : std::max(length(n) / unit, least));
            }
        }
    }
}

}  // namespace

std::vector<Vec3> take_positions(pbrt::ShapeEntity& shape) {
    const pbrt::Location place = shape.parameters.place_of("P");
    std::vector<Vec3> positions = take_vectors<Vec3>(shape.parameters, "P", pbrt::ParameterType::point3);
    if (positions.empty()) {
        throw InputError(place, fmt::format("Shape \"{}\" needs the parameter \"point3 P\"", shape.type));
    }
    return positions;
}

std::vector<std::uint32_t> take_indices(pbrt::ShapeEntity& shape, std::string_view name, std::size_t count,
                                        std::string_view what) {
    const pbrt::Location place = shape.parameters.place_of(name);
    const std::vector<int> given = shape.parameters.take_ints(name);
    std::vector<std::uint32_t> indices;
    indices.reserve(given.size());
    for (const int index : given) {
        if (index < 0 || static_cast<std::size_t>(index) >= count) {
            throw InputError(place, fmt::format("the index {} is out of range: there are {} {}", index, count, what));
        }
        indices.push_back(static_cast<std::uint32_t>(index));
    }
    return indices;
}

TriangleMeshData take_faces(LoadContext& context, pbrt::ShapeEntity& shape, std::size_t corners) {
    const pbrt::Location indices_place = shape.parameters.place_of("indices");
    TriangleMeshData mesh;
    mesh.positions = take_positions(shape);
    mesh.indices = take_indices(shape, "indices", mesh.positions.size(), "vertices");
    if (mesh.indices.empty()) {
        if (mesh.positions.size() != corners) {
            throw InputError(indices_place,
                             fmt::format("Shape \"{}\" needs the parameter \"integer indices\"", shape.type));
        }
        mesh.indices.resize(corners);
        std::iota(mesh.indices.begin(), mesh.indices.end(), 0u);
    }
    if (const std::size_t excess = mesh.indices.size() % corners; excess != 0) {
        context.warnings.add(indices_place,
                             fmt::format("\"indices\" has {} values, which is no multiple of {}: those at its end are "
                                         "left out, as by pbrt",
                                         mesh.indices.size(), corners));
        mesh.indices.resize(mesh.indices.size() - excess);
    }
    return mesh;
}

TriangleMeshData take_mesh(LoadContext& context, pbrt::ShapeEntity& shape, std::size_t corners) {
    TriangleMeshData mesh = take_faces(context, shape, corners);
    mesh.normals = take_vectors<Vec3>(shape.parameters, "N", pbrt::ParameterType::normal3);
    mesh.uvs = take_vectors<Vec2>(shape.parameters, "uv", pbrt::ParameterType::point2);
    mesh.tangents = take_vectors<Vec3>(shape.parameters, "S", pbrt::ParameterType::vector3);
    require_one_a_vertex(context, shape, mesh.normals, mesh.positions.size(), "N");
    require_one_a_vertex(context, shape, mesh.tangents, mesh.positions.size(), "S");
    require_one_a_vertex(context, shape, mesh.uvs, mesh.positions.size(), "uv");
    return mesh;
}

std::vector<Vec3> take_end_positions(pbrt::ShapeEntity& shape, std::size_t vertices) {
    const pbrt::Location place = shape.parameters.place_of("P1");
    std::vector<Vec3> positions = take_vectors<Vec3>(shape.parameters, "P1", pbrt::ParameterType::point3);
    if (!positions.empty() && positions.size() != vertices) {
        throw InputError(place, fmt::format("\"P1\" has {} values for {} vertices", positions.size(), vertices));
    }
    return positions;
}

void take_motion(pbrt::ShapeEntity& shape, TriangleMeshData& mesh) {
    const pbrt::Location place = shape.parameters.place_of("N1");
    mesh.end_positions = take_end_positions(shape, mesh.positions.size());
    mesh.end_normals = take_vectors<Vec3>(shape.parameters, "N1", pbrt::ParameterType::normal3);
    const std::size_t wanted = mesh.end_positions.empty() ? 0 : mesh.normals.size();
    if (mesh.end_normals.size() != wanted) {
        throw InputError(place, fmt::format("\"N1\" has {} values: it must have as many as \"N\" where there is "
                                            "\"P1\", and none otherwise",
                                            mesh.end_normals.size()));
    }
}

TriangleMesh place(const pbrt::ShapeEntity& shape, TriangleMeshData raw) {
    TriangleMesh mesh;
    mesh.positions = std::move(raw.positions);
    mesh.normals = std::move(raw.normals);
    mesh.uvs = std::move(raw.uvs);
    mesh.indices = std::move(raw.indices);
    mesh.tangents = std::move(raw.tangents);
    mesh.end_positions = std::move(raw.end_positions);
    mesh.end_normals = std::move(raw.end_normals);
    mesh.first_quadrilateral = raw.first_quadrilateral;
    for (auto* const positions : {&mesh.positions, &mesh.end_positions}) {
        for (Vec3& v : *positions) {
            v = shape.world_from_object.point(v);
            if (!is_finite(v)) {
                throw InputError(shape.place, fmt::format("Shape \"{}\" has a vertex that is not finite", shape.type));
            }
        }
    }
    for (Vec3& t : mesh.tangents) {
        t = shape.world_from_object.vector(t);
        t = is_finite(t) ? t : Vec3(0, 0, 0);
    }
    place_normals(shape, mesh);
    return mesh;
}

}  // namespace wend
