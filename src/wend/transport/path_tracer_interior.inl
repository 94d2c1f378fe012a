// How the walk of transport/path_tracer.inl, which includes this, stays in dense media behind boundaries.
#pragma once

#include <wend/decision/channels.h>
#include <wend/light/emitter_hit.h>
#include <wend/light/scattering.h>
#include <wend/medium/transmittance.h>
#include <wend/transport/path_tracer.h>

#include <optional>
#include <utility>

namespace wend {

template <class Decisions, class Recorders>
void PathTracer<Decisions, Recorders>::Walk::enter_medium(const Hit& hit, MediumId from) {
    if (now_.medium.id != from && now_.medium.id == hit.surface->interior) {
        if (const auto relative = scene_.relative_albedo(hit)) {
            now_.coloured = now_.medium.id;
            now_.relative_albedo = *relative;
        }
    }
    if (!hit.surface->bounds_medium() || tracer_.subsurface_.is_empty()) {
        return;
    }
    recorder_.record(Paused{now_.interior});
    bool guided = now_.interior.is_inside();
    if (now_.medium.id != from) {
        const TechniqueMix* plan = tracer_.subsurface_.plan(now_.medium.id, hit.position);
        guided = plan && !(sampler_.random().uniform() < plan->unguided_probability);
        now_.is_classical = plan && !guided && plan->is_unguided_classical;
        recorder_.record(EnteredMedium{now_.medium.id, hit.position, plan != nullptr, guided,
                                       plan ? plan->recording_probability : 1.0f, sampler_.random()});
        now_.next_event = !plan ? NextEventSettings{} : guided ? plan->guided : plan->unguided;
        now_.interior.leave();
    }
    if (guided) {
        tracer_.subsurface_.enter(now_.medium.id, hit, now_.ray.direction, channel_probabilities(now_.throughput),
                                  now_.interior);
    }
}

// What the walk would find if it flew out to a lamp from here and were connected there, in place of what it does find:
// a path either way has the same value, and the balance heuristic counts `connected_before` on both.
template <class Decisions, class Recorders>
void PathTracer<Decisions, Recorders>::Walk::connect_at_boundary(const VolumeScattering& f,
                                                                 const InteriorWalk::Directions& directions,
                                                                 const Vertex& v) {
    if (!has_depth_for(scene_.counts_vertices_in(now_.medium.id) ? 1 : 0)) {
        return;
    }
    const std::optional<Vec3> w = directions.sample_emitters();
    const float density = w ? directions.density(*w) : 0.0f;
    if (!(density > 0)) {
        return;
    }
    const Ray ray{v.position, *w};
    const std::optional<Hit> hit = scene_.intersect(ray);
    if (!hit || scene_.is_interface(*hit)) {
        return;
    }
    now_.recorded = recorder_.branch();
    const State here = now_;
    const Rgb phase = f.evaluate(*w);
    recorder_.record(Turning{now_.interior});
    now_.interior.turn(directions, *w);
    now_.ray = ray;
    const float passing = now_.interior.pass(hit->distance);
    const Rgb arriving =
        phase * transmittance(now_.interior.guide()->medium, hit->distance) * (1 / (density * passing));
    now_.throughput *= arriving;
    now_.connected_before = connections_at_boundary * directions.emitter_density(*w) / (density * passing);
    const Vertex there = Vertex::on_surface(*hit, *w);
    const SurfaceScattering boundary = scattering_at(there);
    Rgb brought;
    if (is_finite(arriving) && !boundary.is_specular()) {
        constexpr int n = connections_at_boundary;
        const auto around = d_.direction.at(there.position, boundary, weight_to_bound());
        const float u = sampler_.random().uniform();
        for (int i = 0; i < n; ++i) {
            const auto chosen = choose_light(scene_, tracer_.lights_, there.receiver(), (static_cast<float>(i) + u) / n,
                                             sampler_.random().uniform2(), sampler_.random());
            if (!chosen) {
                continue;
            }
            const Connection found = connect(*chosen, connections(there), boundary, around, there);
            const Rgb light = found.scattering * found.light;
            bring(now_.throughput * light, found.slope);
            brought += arriving * light;
        }
    }
    go_on_from(here);
    recorder_.record(ConnectedAhead{*w, phase, brought});
}

}  // namespace wend
