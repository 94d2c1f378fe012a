#include <wend/capi/boundary.h>
#include <wend/capi/field.h>
#include <wend/guide/path_records.h>

#include <limits>
#include <vector>

using namespace wend;
using namespace wend::capi;

namespace {

guide::PathVertex to_vertex(const wend_path_vertex& v) {
    guide::PathVertex vertex;
    vertex.position = to_vector(v.position);
    vertex.direction = to_vector(v.direction);
    vertex.density = v.density;
    vertex.classical_density = v.classical_density;
    vertex.guided_density = v.guided_density;
    vertex.distance = v.distance;
    vertex.arrival = to_rgb(v.arrival);
    vertex.scattering = to_rgb(v.scattering);
    vertex.gathered = to_rgb(v.gathered);
    vertex.connected = to_rgb(v.connected);
    vertex.to_light = to_vector(v.to_light);
    vertex.light_distance = v.light_distance;
    vertex.light_fluence = v.light_fluence;
    vertex.normal = to_vector(v.normal);
    vertex.parent = v.parent;
    return vertex;
}

wend_record from_record(const guide::Record& r) {
    return {from_vector(r.position),
            from_vector(r.direction),
            r.radiance,
            r.density,
            r.distance,
            r.classical_density,
            r.guided_density,
            r.scattered,
            {r.colour.r, r.colour.g, r.colour.b}};
}

wend_scatter_record from_record(const guide::ScatterRecord& r) {
    return {from_vector(r.position), from_vector(r.normal), r.leaving, r.connected,
            from_vector(r.to_light), r.light_distance};
}

/// Writes what `record_of` makes of each vertex and of the radiance that arrived there.
template <class Record, class RecordOf>
wend_status write_records(const wend_path_vertex* path, size_t count, Record* records, const RecordOf& record_of,
                          wend_error* error) noexcept {
    return guarded(error, [&] {
        require(count == 0 || (path && records), "the path or the place for its records is null");
        require(count <= static_cast<std::size_t>(std::numeric_limits<std::int32_t>::max()),
                "a path has 2^31 - 1 vertices at most");
        std::vector<guide::PathVertex> vertices;
        vertices.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            require(path[i].parent >= -1 && path[i].parent < static_cast<std::int64_t>(i),
                    "the parent of a vertex must be -1 or an index lower than its own");
            vertices.push_back(to_vertex(path[i]));
        }
        std::vector<Rgb> incident;
        guide::incident_radiance(vertices, incident);
        for (std::size_t i = 0; i < count; ++i) {
            records[i] = from_record(record_of(vertices[i], incident[i]));
        }
        return WEND_OK;
    });
}

}  // namespace

wend_status wend_records_of_path(const wend_path_vertex* path, size_t count, wend_record* records,
                                 wend_error* error) noexcept {
    return write_records(path, count, records, guide::record_of, error);
}

wend_status wend_scatter_records_of_path(const wend_path_vertex* path, size_t count, wend_scatter_record* records,
                                         wend_error* error) noexcept {
    return write_records(path, count, records, guide::scatter_record_of, error);
}
