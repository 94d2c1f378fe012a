#include <wend/capi/boundary.h>
#include <wend/capi/handles.h>
#include <wend/capi/media.h>
#include <wend/decision/guided_distance.h>

#include <cstddef>

using namespace wend;
using namespace wend::capi;

namespace {

using Distance = GuidedDistance<guide::Field>;

FlightEnd to_end(const wend_flight_end& end) {
    require(end.kind >= WEND_END_NOTHING && end.kind <= WEND_END_INTERFACE, "there is no such end of a flight");
    require_weight(end.emitted, "what is emitted at the end");
    FlightEnd result;
    result.kind = static_cast<FlightEnd::Kind>(end.kind);
    result.emitted = end.emitted;
    if (end.kind != WEND_END_NOTHING) {
        result.position = to_position(end.position, "the position of the end");
    }
    if (end.kind == WEND_END_SURFACE) {
        result.normal = to_direction(end.normal, "the normal of the end");
    }
    return result;
}

FlightStart to_start(const wend_flight_start* start) {
    require(start, "the start of the flight is null");
    require_length(start->length);
    require_weight(start->weight, "the weight");
    return {{to_position(start->origin, "the origin"), to_direction(start->direction, "the direction")},
            start->length,
            to_weight(start->throughput, "the throughput"),
            start->weight,
            to_end(start->end),
            {}};
}

void put(const Flight& flight, wend_flight& result) {
    result.scatters = flight.scatters ? 1 : 0;
    result.distance = flight.distance;
    capi::put(flight.weight, result.weight);
    result.density_ratio = flight.density_ratio;
}

/// Draws a flight by a decision. What is homogeneous asks for no numbers beyond u.
template <DistanceDecision Decision>
void fly(const Decision& decision, const wend_medium* medium, const wend_flight_start* start, float u,
         wend_flight* flight) {
    require(flight, "the place for the flight is null");
    require_uniform(u);
    Pcg32 unused(0);
    put(decision.sample(to_medium(medium), to_start(start), u, unused), *flight);
}

wend_vec3 from_mean(const guide::ArrivingLight& light) {
    return from_vector(light.mean);
}

wend_ray_cell from_cell(const guide::ScatteredLight& light, float t_in, float t_out) {
    const guide::NearLight& near = light.near;
    return {t_in,
            t_out,
            {light.walked.fluence, from_mean(light.walked)},
            {light.connected.fluence, from_mean(light.connected)},
            {from_vector(near.position), near.extent_squared, near.intensity, near.share},
            light.confidence};
}

}  // namespace

wend_status wend_flight_classical(const wend_medium* medium, const wend_flight_start* start, float u,
                                  wend_flight* flight, wend_error* error) noexcept {
    return guarded(error, [&] {
        fly(ClassicalDistance(), medium, start, u, flight);
        return WEND_OK;
    });
}

wend_status wend_flight_guided(const wend_field* surface, const wend_field* volume,
                               const wend_flight_settings* settings, const wend_medium* medium,
                               const wend_flight_start* start, float u, wend_flight* flight,
                               wend_error* error) noexcept {
    return guarded(error, [&] {
        require(surface && volume, "a field is null");
        require(settings, "the settings are null");
        require(settings->classical_share > 0 && settings->classical_share <= 1,
                "the classical share must be in (0,1]");
        require(settings->guiding == WEND_GUIDE_SCATTERING || settings->guiding == WEND_GUIDE_SCATTERING_AND_DISTANCE,
                "there is no such guiding of flights");
        const auto guiding = settings->guiding == WEND_GUIDE_SCATTERING ? DistanceGuiding::scatter_alone
                                                                        : DistanceGuiding::scatter_and_distance;
        fly(Distance(&surface->value, &volume->value, settings->classical_share, guiding), medium, start, u, flight);
        return WEND_OK;
    });
}

wend_status wend_flight_looks_ahead(const wend_medium* medium, const wend_flight_start* start, int* looks,
                                    wend_error* error) noexcept {
    return guarded(error, [&] {
        require(looks, "the place for the answer is null");
        *looks = Distance::can_be_guided(to_medium(medium), to_start(start)) ? 1 : 0;
        return WEND_OK;
    });
}

wend_status wend_flight_pass_probability(const wend_medium* medium, float length, float probability[3],
                                         wend_error* error) noexcept {
    return guarded(error, [&] {
        require(probability, "the place for the probability is null");
        require_length(length);
        put(ClassicalDistance().pass_probability(to_medium(medium), Ray(), length), probability);
        return WEND_OK;
    });
}

wend_status wend_field_cells_along_ray(const wend_field* field, wend_vec3 origin, wend_vec3 direction, float t0,
                                       float t1, float finest, wend_ray_cell* cells, size_t capacity, size_t* count,
                                       wend_error* error) noexcept {
    return guarded(error, [&] {
        require(field, "the field is null");
        require(count, "the place for the number of cells is null");
        const Ray ray{to_position(origin, "the origin"), to_direction(direction, "the direction")};
        require(t0 >= 0 && t0 < t1 && t1 <= longest_segment, "the distances must be 0 <= t0 < t1 <= 1e30");
        require_weight(finest, "what is finest");
        if (!field->value.is_trained()) {
            return answer(error, WEND_NOTHING_LEARNED, nothing_learned);
        }
        std::size_t found = 0;
        const auto visit = [&](const guide::ScatteredLight& light, float t_in, float t_out) {
            if (cells && found < capacity) {
                cells[found] = from_cell(light, t_in, t_out);
            }
            ++found;
            return true;
        };
        field->value.walk(ray, t0, t1, visit, finest);
        *count = found;
        return cells && found > capacity
                   ? answer(error, WEND_BUFFER_TOO_SMALL, "there are more cells than the array holds")
                   : WEND_OK;
    });
}

wend_status wend_field_leaving(const wend_field* field, wend_vec3 position, wend_vec3 normal, float* radiance,
                               wend_error* error) noexcept {
    return guarded(error, [&] {
        require(field, "the field is null");
        require(radiance, "the place for the radiance is null");
        const Vec3 p = to_position(position, "the position"), n = to_direction(normal, "the normal");
        if (!field->value.is_trained()) {
            return answer(error, WEND_NOTHING_LEARNED, nothing_learned);
        }
        *radiance = field->value.leaving(p, n);
        return WEND_OK;
    });
}
