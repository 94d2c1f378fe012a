#include <wend/capi/boundary.h>
#include <wend/guide/path_records.h>

#include <limits>
#include <span>

using namespace wend;
using namespace wend::capi;

namespace {

Rgb to_rgb(const float (&c)[3]) {
    return {c[0], c[1], c[2]};
}

guide::PathVertex to_vertex(const wend_path_vertex& v) {
    guide::PathVertex vertex;
    vertex.position = {v.position.x, v.position.y, v.position.z};
    vertex.direction = {v.direction.x, v.direction.y, v.direction.z};
    vertex.density = v.density;
    vertex.classical_density = v.classical_density;
    vertex.guided_density = v.guided_density;
    vertex.distance = v.distance;
    vertex.arrival = to_rgb(v.arrival);
    vertex.scattering = to_rgb(v.scattering);
    vertex.gathered = to_rgb(v.gathered);
    vertex.parent = v.parent;
    return vertex;
}

}  // namespace

wend_status wend_records_of_path(const wend_path_vertex* path, size_t count, wend_record* records,
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
            const guide::Record r = guide::record_of(vertices[i], incident[i]);
            records[i] = {from_vector(r.position),
                          from_vector(r.direction),
                          r.radiance,
                          r.density,
                          r.distance,
                          r.classical_density,
                          r.guided_density,
                          r.scattered,
                          {r.colour.r, r.colour.g, r.colour.b}};
        }
        return WEND_OK;
    });
}
