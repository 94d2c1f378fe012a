// How the walk of transport/path_tracer.inl, which includes this, connects its vertices to lights.
#pragma once

#include <wend/decision/channels.h>
#include <wend/light/next_event.h>
#include <wend/light/scattering.h>
#include <wend/transport/path_tracer.h>

#include <algorithm>
#include <concepts>
#include <optional>

namespace wend {

template <class Decisions, class Recorders>
template <class F, class Directions>
void PathTracer<Decisions, Recorders>::Walk::connect_to_lights(const F& f, const Directions& directions,
                                                               const Vertex& v) {
    const float often = connections(v);
    const bool is_left_out = often < 1 && !(sampler_.random().uniform() < often);
    if (is_left_out && !scene_.has_point_like_lights()) {
        return;
    }
    const int n = std::max(1, static_cast<int>(often));
    const float u = sampler_.uniform();
    for (int i = 0; i < n; ++i) {
        // Several go through the lights in their order.
        const auto chosen =
            choose_light(scene_, tracer_.lights_, v.receiver(), (static_cast<float>(i) + u) / static_cast<float>(n),
                         i == 0 ? sampler_.uniform2() : sampler_.random().uniform2(), sampler_.random());
        if (!chosen || (is_left_out && !chosen->light.point_like)) {
            continue;
        }
        // What only connections find is never left out.
        const float times = chosen->light.point_like ? std::max(1.0f, often) : often;
        take(connect(*chosen, times, f, directions, v), v, *chosen, times);
    }
}

template <class Decisions, class Recorders>
template <class F, class Directions>
void PathTracer<Decisions, Recorders>::Walk::connect_through_boundaries(const F& f, const Directions& directions,
                                                                        const Vertex& v) {
    const float often = now_.next_event.through_boundaries;
    if (often == 0 || !(sampler_.random().uniform() < often)) {
        return;
    }
    const auto chosen = choose_light(scene_, tracer_.lights_, v.receiver(), sampler_.random().uniform(),
                                     sampler_.random().uniform2(), sampler_.random());
    if (!chosen || !is_seen_through_boundaries(scene_.lights()[static_cast<std::size_t>(chosen->index)])) {
        return;
    }
    Connection found;
    if (const auto sight = look_through_boundaries(*chosen, directions, v)) {
        found = weigh(*sight, often, chosen->light.point_like, f.evaluate(sight->direction), directions, v);
        recorder_.record(SawLight{now_.medium.id, true});
    }
    take(found, v, *chosen, often);
}

template <class Decisions, class Recorders>
void PathTracer<Decisions, Recorders>::Walk::take(const Connection& found, const Vertex& v, const ChosenSample& chosen,
                                                  float times) {
    const Rgb brought = found.scattering * found.light;
    gather(brought, found.slope);
    recorder_.record(Connected{v, chosen.index, chosen.probability, times, found.to_light, found.distance,
                               mean_value(found.light), brought});
}

template <class Decisions, class Recorders>
template <class F, class Directions>
auto PathTracer<Decisions, Recorders>::Walk::connect(const ChosenSample& chosen, float times, const F& f,
                                                     const Directions& directions, const Vertex& v) -> Connection {
    const Rgb value = f.evaluate(chosen.light.direction);
    if (is_black(value)) {
        return {};
    }
    const Sight sight = look_straight(chosen, directions, v);
    if (is_black(sight.passage.transmittance)) {
        return {};
    }
    if (v.in_volume()) {
        recorder_.record(SawLight{now_.medium.id, false});
    }
    return weigh(sight, times + now_.connected_before, chosen.light.point_like, value, directions, v);
}

template <class Decisions, class Recorders>
template <class Directions>
auto PathTracer<Decisions, Recorders>::Walk::weigh(const Sight& sight, float often, bool point_like, const Rgb& value,
                                                   const Directions& directions, const Vertex& v) const -> Connection {
    const float density = often * sight.density;
    float other = 0;
    if (!point_like) {
        const Rgb channels = channel_probabilities(now_.throughput * value);
        other = preference(v) * directions.density(sight.direction) * dot(channels, sight.passage.probability);
    }
    Connection found{sight.direction, sight.distance,
                     sight.radiance * sight.passage.transmittance * (1 / (density + other)), value, std::nullopt};
    if (v.in_volume() && now_.interior.is_inside()) {
        found.slope = recorder_.template get<InteriorRecorder>().gradient_inside(now_.interior, sight.interior,
                                                                                 density / (density + other));
    } else if (now_.connected_before > 0) {
        found.slope = recorder_.template get<InteriorRecorder>().gradient_at_boundary(
            now_.interior, now_.connected_before * sight.density / (density + other));
    }
    return found;
}

template <class Decisions, class Recorders>
template <class Directions>
InteriorWalk PathTracer<Decisions, Recorders>::Walk::interior_towards(const Vec3& direction,
                                                                      const Directions& directions) const {
    InteriorWalk interior;
    if constexpr (std::same_as<Directions, InteriorWalk::Directions>) {
        interior = now_.interior;
        interior.turn(directions, direction);
    }
    return interior;
}

template <class Decisions, class Recorders>
template <class Directions>
auto PathTracer<Decisions, Recorders>::Walk::look_straight(const ChosenSample& chosen, const Directions& directions,
                                                           const Vertex& v) -> Sight {
    const LightSample& light = chosen.light;
    Sight sight{light.direction,
                light.distance,
                light.radiance,
                chosen.density(),
                interior_towards(light.direction, directions),
                {}};
    const ShadowRay shadow = shadow_ray(scene_, leave(v, light.direction), v.position, chosen);
    sight.passage =
        pass(scene_, d_.distance, shadow, medium_towards(v, light.direction), sight.interior, sampler_.random());
    return sight;
}

template <class Decisions, class Recorders>
template <class Directions>
auto PathTracer<Decisions, Recorders>::Walk::look_through_boundaries(const ChosenSample& chosen,
                                                                     const Directions& directions, const Vertex& v)
    -> std::optional<Sight> {
    const LightSample& light = chosen.light;
    const Light& source = scene_.lights()[static_cast<std::size_t>(chosen.index)];
    const auto way = find_specular_chain(scene_, {v.position, light.direction}, light.distance, now_.medium);
    const bool is_far = light.distance == infinity;
    if (!way || (!is_far && way->end.light != chosen.index) || !has_depth_for(way->vertices)) {
        return std::nullopt;
    }
    const Vec3 arriving = -way->legs().back().ray.direction;
    Sight sight{way->direction,
                infinity,
                is_far ? environment_radiance(source, -arriving) : emitted_radiance(source, way->end.normal, arriving),
                chosen.density() * way->density_ratio,
                interior_towards(way->direction, directions),
                {}};
    sight.passage = pass(scene_, d_.distance, *way, sight.interior, sampler_.random());
    return sight;
}

}  // namespace wend
