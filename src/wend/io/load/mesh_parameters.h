// What shapes that are given by points and faces have in common.
#pragma once

#include <wend/io/load/context.h>
#include <wend/io/ply.h>
#include <wend/scene/shape.h>

#include <cstddef>
#include <string_view>
#include <vector>

namespace wend {

/// Moves a list of vectors out of the parameters.
template <class Vector>
std::vector<Vector> take_vectors(pbrt::ParameterSet& p, std::string_view name, pbrt::ParameterType type) {
    const std::vector<float> numbers = p.take_numbers(name, type);
    constexpr std::size_t n = Vector::dimensions();
    std::vector<Vector> vectors(numbers.size() / n);
    for (std::size_t i = 0; i < vectors.size(); ++i) {
        for (std::size_t axis = 0; axis < n; ++axis) {
            vectors[i][static_cast<int>(axis)] = numbers[n * i + axis];
        }
    }
    return vectors;
}

/// The parameter P. Throws InputError if there is none.
std::vector<Vec3> take_positions(pbrt::ShapeEntity& shape);

/// A list of indices below `count`, which are of `what` ("vertices"); empty where it is absent. Throws InputError for
/// others.
std::vector<std::uint32_t> take_indices(pbrt::ShapeEntity& shape, std::string_view name, std::size_t count,
                                        std::string_view what);

/// The parameters P and indices, `corners` of these a face; what is left at their end is dropped with a warning, as
/// pbrt does. Without indices the vertices are a single face.
TriangleMeshData take_faces(LoadContext& context, pbrt::ShapeEntity& shape, std::size_t corners);

/// take_faces(), and the parameters N and uv; those that are not one a vertex are dropped with a warning, as pbrt does.
TriangleMeshData take_mesh(LoadContext& context, pbrt::ShapeEntity& shape, std::size_t corners);

/// The parameter P1, which pbrt has not: where vertices are at time 1; empty where it is absent. Throws InputError if
/// it has not one value a vertex.
std::vector<Vec3> take_end_positions(pbrt::ShapeEntity& shape, std::size_t vertices);

/// The same and N1, which goes with N, of a mesh whose vertices and normals are known. Throws InputError if these are
/// not as many.
void take_motion(pbrt::ShapeEntity& shape, TriangleMeshData& mesh);

/// To the world; normals that are given turn with ReverseOrientation. Throws InputError for vertices that are not
/// finite.
TriangleMesh place(const pbrt::ShapeEntity& shape, TriangleMeshData raw);

}  // namespace wend
