#include <wend/io/ply.h>

#include <wend/core/error.h>
#include <wend/io/gzip.h>
#include <wend/io/ply_attributes.h>
#include <wend/io/ply_header.h>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <string>
#include <string_view>

namespace wend {
namespace {

using ply::AttributeRows;
using ply::bytes_of;
using ply::Element;
using ply::Format;
using ply::Header;
using ply::is_space;
using ply::Property;
using ply::Type;

/// Numbers of an ascii file, wherever its lines break.
class AsciiReader {
public:
    AsciiReader(std::string_view body, Place place)
        : at_(body.data()), end_(at_ + body.size()), place_(std::move(place)) {}

    double next(Type) {
        while (at_ != end_ && is_space(*at_)) {
            place_.line += *at_++ == '\n';
        }
        if (at_ == end_) {
            throw InputError(place_, "the file is truncated");
        }
        const char* begin = *at_ == '+' ? at_ + 1 : at_;
        double value = 0;
        const auto [stop, error] = std::from_chars(begin, end_, value);
        if (error == std::errc::result_out_of_range) {
            value = std::strtod(begin, nullptr);  // tells underflow from overflow
        } else if (error != std::errc() || (stop != end_ && !is_space(*stop))) {
            const char* word_end = std::find_if(at_, std::min(end_, at_ + 40), is_space);
            throw InputError(place_, fmt::format("`{}` is not a number", std::string_view(at_, word_end - at_)));
        }
        at_ = stop;
        return value;
    }

    /// The least that a value takes: a digit and a separator, which the last one lacks.
    static std::size_t least_bytes(Type) { return 2; }
    std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_) + 1; }
    const Place& place() const { return place_; }

private:
    const char* at_;
    const char* end_;
    Place place_;
};

/// Numbers of a binary file, of this machine's byte order or of the other one.
template <bool swapped>
class BinaryReader {
public:
    BinaryReader(std::string_view body, Place place)
        : at_(body.data()), end_(at_ + body.size()), place_(std::move(place)) {}

    double next(Type type) {
        switch (type) {
            case Type::int8:
                return take<std::int8_t>();
            case Type::uint8:
                return take<std::uint8_t>();
            case Type::int16:
                return take<std::int16_t>();
            case Type::uint16:
                return take<std::uint16_t>();
            case Type::int32:
                return take<std::int32_t>();
            case Type::uint32:
                return take<std::uint32_t>();
            case Type::float32:
                return take<float>();
            case Type::float64:
                return take<double>();
        }
        return 0;
    }

    static std::size_t least_bytes(Type type) { return bytes_of(type); }
    std::size_t bytes_left() const { return static_cast<std::size_t>(end_ - at_); }
    const Place& place() const { return place_; }

private:
    template <class T>
    T take() {
        if (bytes_left() < sizeof(T)) {
            throw InputError(place_, "the file is truncated");
        }
        std::array<char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), at_, sizeof(T));
        at_ += sizeof(T);
        if constexpr (swapped) {
            std::reverse(bytes.begin(), bytes.end());
        }
        return std::bit_cast<T>(bytes);
    }

    const char* at_;
    const char* end_;
    Place place_;
};

/// Where the value of a vertex's property goes: a position in this row.
struct VertexRow {
    enum Slot { x, y, z, nx, ny, nz, u, v, none, count };
    std::array<float, count> values{};

    bool finite(Slot first, int n) const {
        return std::all_of(values.begin() + first, values.begin() + first + n,
                           [](float f) { return std::isfinite(f); });
    }
};

VertexRow::Slot slot_of(const Property& property) {
    if (property.count_type) {
        return VertexRow::none;
    }
    std::string_view name = property.name;
    constexpr std::string_view prefix = "texture_";
    const bool texture = name.substr(0, prefix.size()) == prefix;
    if (texture) {
        name.remove_prefix(prefix.size());
    }
    if (name == "u" || name == "s") {
        return VertexRow::u;
    }
    if (name == "v" || name == "t") {
        return VertexRow::v;
    }
    constexpr std::array<std::string_view, 6> names{"x", "y", "z", "nx", "ny", "nz"};
    const auto found = texture ? names.end() : std::find(names.begin(), names.end(), name);
    return found == names.end() ? VertexRow::none : static_cast<VertexRow::Slot>(found - names.begin());
}

template <class Reader>
class BodyParser {
public:
    BodyParser(const Header& header, Reader reader, bool with_attributes)
        : header_(header), reader_(std::move(reader)), with_attributes_(with_attributes) {}

    TriangleMeshData parse() {
        for (const Element& element : header_.elements) {
            check_count(element);
            if (element.name == "vertex") {
                read_vertices(element);
            } else if (element.properties.empty()) {
                // It takes no bytes, however many it claims to have.
            } else if (element.name == "face") {
                read_faces(element);
            } else {
                for (std::uint64_t i = 0; i < element.count; ++i) {
                    for (const Property& property : element.properties) {
                        skip(property);
                    }
                }
            }
        }
        return std::move(mesh_);
    }

private:
    void check_count(const Element& element) const {
        std::size_t least = 0;
        for (const Property& property : element.properties) {
            least += Reader::least_bytes(property.count_type.value_or(property.type));
        }
        if (least > 0 && element.count > reader_.bytes_left() / least) {
            throw InputError(reader_.place(),
                             fmt::format("the file is truncated: it is too short for {} of the element `{}`",
                                         element.count, element.name));
        }
    }

    void read_vertices(const Element& element) {
        std::vector<VertexRow::Slot> slots;
        for (const Property& property : element.properties) {
            slots.push_back(slot_of(property));
        }
        const auto has = [&](VertexRow::Slot first, int n) {
            for (int slot = first; slot < first + n; ++slot) {
                if (std::find(slots.begin(), slots.end(), slot) == slots.end()) {
                    return false;
                }
            }
            return true;
        };
        if (!has(VertexRow::x, 3)) {
            throw InputError(Place{reader_.place().file}, "the vertices lack the properties x, y and z");
        }
        if (element.count > std::numeric_limits<std::uint32_t>::max()) {
            throw InputError(Place{reader_.place().file}, "the mesh has too many vertices for 32-bit indices");
        }
        const bool has_normals = has(VertexRow::nx, 3), has_uvs = has(VertexRow::u, 2);
        mesh_.positions.reserve(element.count);
        mesh_.normals.reserve(has_normals ? element.count : 0);
        mesh_.uvs.reserve(has_uvs ? element.count : 0);
        VertexRow row;
        AttributeRows attributes(with_attributes_ ? element : Element{}, "vertex_");
        for (std::uint64_t i = 0; i < element.count; ++i) {
            for (std::size_t p = 0; p < slots.size(); ++p) {
                const Property& property = element.properties[p];
                if (property.count_type) {
                    skip(property);
                } else {
                    const double value = reader_.next(property.type);
                    row.values[slots[p]] = static_cast<float>(value);
                    if (with_attributes_) {
                        attributes.set(p, value);
                    }
                }
            }
            attributes.add_row();
            if (!row.finite(VertexRow::x, 3)) {
                throw InputError(reader_.place(), fmt::format("vertex {} is not finite", i));
            }
            const auto& v = row.values;
            mesh_.positions.emplace_back(v[VertexRow::x], v[VertexRow::y], v[VertexRow::z]);
            if (has_normals) {
                mesh_.normals.emplace_back(v[VertexRow::nx], v[VertexRow::ny], v[VertexRow::nz]);
            }
            if (has_uvs) {
                mesh_.uvs.push_back(row.finite(VertexRow::u, 2) ? Vec2(v[VertexRow::u], v[VertexRow::v]) : Vec2(0, 0));
            }
        }
        add_attributes(attributes);
    }

    void read_faces(const Element& element) {
        const Element* vertices = header_.find("vertex");
        const double vertex_count = vertices ? static_cast<double>(vertices->count) : 0;
        mesh_.indices.reserve(3 * element.count);
        AttributeRows attributes(with_attributes_ ? element : Element{}, "face_");
        for (std::uint64_t i = 0; i < element.count; ++i) {
            const std::size_t before = mesh_.indices.size();
            for (std::size_t p = 0; p < element.properties.size(); ++p) {
                const Property& property = element.properties[p];
                if (property.count_type && (property.name == "vertex_indices" || property.name == "vertex_index")) {
                    read_polygon(property, i, vertex_count);
                } else if (with_attributes_ && !property.count_type) {
                    attributes.set(p, reader_.next(property.type));
                } else {
                    skip(property);
                }
            }
            for (std::size_t corner = before; corner < mesh_.indices.size(); corner += 3) {
                attributes.add_row();
            }
        }
        add_attributes(attributes);
    }

    void add_attributes(AttributeRows& rows) {
        for (MeshAttribute& attribute : rows.take()) {
            mesh_.attributes.push_back(std::move(attribute));
        }
    }

    void read_polygon(const Property& property, std::uint64_t face, double vertex_count) {
        const std::uint64_t corners = list_size(property);
        if (corners == 4) {
            mesh_.quadrilaterals.push_back(static_cast<std::uint32_t>(mesh_.indices.size() / 3));
        }
        std::uint32_t first = 0, previous = 0;
        for (std::uint64_t corner = 0; corner < corners; ++corner) {
            const double index = reader_.next(property.type);
            if (!(index >= 0 && index < vertex_count) || index != std::floor(index)) {
                throw InputError(reader_.place(), fmt::format("face {} refers to vertex {}, but there are {} vertices",
                                                              face, index, vertex_count));
            }
            const auto current = static_cast<std::uint32_t>(index);
            if (corner == 0) {
                first = current;
            } else if (corner >= 2) {
                mesh_.indices.insert(mesh_.indices.end(), {first, previous, current});
            }
            previous = current;
        }
    }

    std::uint64_t list_size(const Property& property) {
        const double size = reader_.next(*property.count_type);
        if (!(size >= 0) || size != std::floor(size)) {
            throw InputError(reader_.place(), fmt::format("a list cannot have {} entries", size));
        }
        if (size * static_cast<double>(Reader::least_bytes(property.type)) >
            static_cast<double>(reader_.bytes_left())) {
            throw InputError(reader_.place(), fmt::format("the file is truncated: a list of {} entries", size));
        }
        return static_cast<std::uint64_t>(size);
    }

    void skip(const Property& property) {
        const std::uint64_t values = property.count_type ? list_size(property) : 1;
        for (std::uint64_t i = 0; i < values; ++i) {
            reader_.next(property.type);
        }
    }

    const Header& header_;
    Reader reader_;
    bool with_attributes_;
    TriangleMeshData mesh_;
};

template <class Reader>
TriangleMeshData parse_body(const Header& header, std::string_view body, const Place& place, bool with_attributes) {
    return BodyParser<Reader>(header, Reader(body, place), with_attributes).parse();
}

}  // namespace

TriangleMeshData read_ply(const std::filesystem::path& file, bool with_attributes) {
    const std::string bytes = read_file(file);
    const Header header = ply::parse_header(bytes, file.string());
    const std::string_view body = std::string_view(bytes).substr(header.bytes);
    if (!header.find("vertex") || !header.find("face")) {
        throw InputError(Place{file.string()}, "a mesh needs the elements `vertex` and `face`");
    }
    if (header.format == Format::ascii) {
        return parse_body<AsciiReader>(header, body, {file.string(), header.lines + 1, 1}, with_attributes);
    }
    const bool native = (header.format == Format::little_endian) == (std::endian::native == std::endian::little);
    return native ? parse_body<BinaryReader<false>>(header, body, {file.string()}, with_attributes)
                  : parse_body<BinaryReader<true>>(header, body, {file.string()}, with_attributes);
}

}  // namespace wend
