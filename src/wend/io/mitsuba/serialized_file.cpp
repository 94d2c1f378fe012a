#include <wend/io/mitsuba/serialized_file.h>

#include <wend/core/error.h>
#include <wend/io/bytes.h>
#include <wend/io/gzip.h>

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cstdint>
#include <limits>
#include <string>

namespace wend::mitsuba {
namespace {

constexpr std::size_t most_unpacked_bytes = std::size_t{4} << 30;

enum Flags : std::uint32_t {
    has_normals = 0x1,
    has_uvs = 0x2,
    has_colours = 0x8,
    face_normals = 0x10,
    single_precision = 0x1000,
    double_precision = 0x2000
};

/// Unpacks as far as the stream goes.
std::string inflated(std::string_view packed, const Place& place) {
    z_stream stream{};
    if (inflateInit(&stream) != Z_OK) {
        throw InputError(place, "cannot be unpacked");
    }
    std::string result;
    int status = Z_OK;
    constexpr std::size_t chunk = std::size_t{1} << 20;
    while (status == Z_OK && result.size() < most_unpacked_bytes) {
        const std::size_t used = result.size();
        const std::size_t input = std::min(packed.size(), chunk);
        result.resize(used + chunk);
        stream.next_in = reinterpret_cast<Bytef*>(const_cast<char*>(packed.data()));
        stream.avail_in = static_cast<uInt>(input);
        stream.next_out = reinterpret_cast<Bytef*>(result.data() + used);
        stream.avail_out = static_cast<uInt>(chunk);
        status = inflate(&stream, Z_NO_FLUSH);
        packed.remove_prefix(input - stream.avail_in);
        result.resize(used + chunk - stream.avail_out);
    }
    inflateEnd(&stream);
    if (status != Z_STREAM_END) {
        throw InputError(place, status == Z_OK ? "a mesh is larger than 4 GiB" : "the file is broken or truncated");
    }
    return result;
}

/// A number of the mesh, of either precision.
float take_number(Bytes& bytes, bool is_double) {
    return is_double ? static_cast<float>(bytes.take<double>()) : bytes.take<float>();
}

template <class Vector>
std::vector<Vector> take_vectors(Bytes& bytes, std::uint64_t count, bool is_double) {
    constexpr unsigned n = Vector::dimensions();
    const std::size_t size = n * (is_double ? sizeof(double) : sizeof(float));
    if (count > bytes.left() / size) {
        bytes.take(std::numeric_limits<std::uint64_t>::max());  // says that the file is truncated
    }
    std::vector<Vector> vectors(static_cast<std::size_t>(count));
    for (Vector& vector : vectors) {
        for (unsigned i = 0; i < n; ++i) {
            vector[static_cast<int>(i)] = take_number(bytes, is_double);
        }
    }
    return vectors;
}

void skip_name(Bytes& bytes) {
    while (bytes.take<char>() != '\0') {
    }
}

SerializedMesh read_mesh(const std::string& content, int version, const Place& place) {
    Bytes bytes(content, place);
    const auto flags = bytes.take<std::uint32_t>();
    if (version >= 4) {
        skip_name(bytes);
    }
    const auto vertices = bytes.take<std::uint64_t>(), triangles = bytes.take<std::uint64_t>();
    if (((flags & single_precision) != 0) == ((flags & double_precision) != 0) ||
        vertices > std::numeric_limits<std::uint32_t>::max()) {
        throw InputError(place, "the head of a mesh is broken");
    }
    const bool is_double = (flags & double_precision) != 0;
    SerializedMesh result;
    TriangleMeshData& mesh = result.mesh;
    result.has_face_normals = (flags & face_normals) != 0;
    mesh.positions = take_vectors<Vec3>(bytes, vertices, is_double);
    if (flags & has_normals) {
        mesh.normals = take_vectors<Vec3>(bytes, vertices, is_double);
    }
    if (flags & has_uvs) {
        mesh.uvs = take_vectors<Vec2>(bytes, vertices, is_double);
    }
    if (flags & has_colours) {
        MeshAttribute colours{"vertex_color", 3, {}};
        for (const Vec3& colour : take_vectors<Vec3>(bytes, vertices, is_double)) {
            colours.values.insert(colours.values.end(), {colour.x, colour.y, colour.z});
        }
        mesh.attributes.push_back(std::move(colours));
    }
    if (triangles > bytes.left() / (3 * sizeof(std::uint32_t))) {
        throw InputError(place, "the file is truncated");
    }
    mesh.indices.resize(static_cast<std::size_t>(3 * triangles));
    for (std::uint32_t& index : mesh.indices) {
        index = bytes.take<std::uint32_t>();
        if (index >= vertices) {
            throw InputError(place,
                             fmt::format("the index {} is out of range: there are {} vertices", index, vertices));
        }
    }
    if (!std::all_of(mesh.positions.begin(), mesh.positions.end(), [](const Vec3& p) { return is_finite(p); })) {
        throw InputError(place, "a position is not finite");
    }
    return result;
}

}  // namespace

SerializedMesh read_serialized(const std::filesystem::path& file, int index) {
    const Place place{file.string(), 0, 0};
    const std::string content = read_file(file);
    Bytes bytes(content, place);
    constexpr std::uint16_t signature = 0x041C;
    constexpr std::size_t head = 2 * sizeof(std::uint16_t);
    if (bytes.take<std::uint16_t>() != signature) {
        throw InputError(place, "this is no file of serialized meshes");
    }
    const auto version = bytes.take<std::uint16_t>();
    if (version != 3 && version != 4) {
        throw InputError(place, fmt::format("only versions 3 and 4 can be read, not {}", version));
    }
    // At the end is where each mesh begins, and how many there are.
    const std::size_t entry = version == 4 ? sizeof(std::uint64_t) : sizeof(std::uint32_t);
    bytes.seek(content.size() - std::min(content.size(), sizeof(std::uint32_t)));
    const auto count = bytes.take<std::uint32_t>();
    const std::size_t table = entry * std::size_t{count} + sizeof(std::uint32_t);
    if (table > content.size() - head) {
        throw InputError(place, "the file is broken or truncated");
    }
    if (index < 0 || static_cast<std::uint32_t>(index) >= count) {
        throw InputError(place, fmt::format("there is no mesh {}: the file has {}, from 0", index, count));
    }
    bytes.seek(content.size() - table + entry * static_cast<std::size_t>(index));
    const std::uint64_t begin = version == 4 ? bytes.take<std::uint64_t>() : bytes.take<std::uint32_t>();
    bytes.seek(begin);
    bytes.take(head);
    const std::size_t at = static_cast<std::size_t>(begin) + head;
    return read_mesh(inflated(std::string_view(content).substr(at), place), version, place);
}

}  // namespace wend::mitsuba
