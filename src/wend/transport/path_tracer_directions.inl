// How the walk of transport/path_tracer.inl, which includes this, goes on from its vertices: in how many copies, in
// what direction, and whether at all.
#pragma once

#include <wend/core/contracts.h>
#include <wend/decision/channels.h>
#include <wend/light/scattering.h>
#include <wend/transport/path_tracer.h>

#include <algorithm>
#include <concepts>
#include <optional>
#include <utility>

namespace wend {

template <class Decisions, class Recorders>
template <class F, class Directions>
bool PathTracer<Decisions, Recorders>::Walk::scatter(const F& f, const Directions& directions, const Vertex& v) {
    if (!f.is_specular()) {
        connect_to_lights(f, directions, v);
    }
    if (v.in_volume()) {
        connect_through_boundaries(f, directions, v);
    }
    const std::optional<WeightWindow::Outcome> outcome =
        d_.survival.before_direction({expected_ratio(f, directions), weight(), split_capacity()}, sampler_.random());
    if (!outcome) {
        return draw_direction(f, directions, v, false);
    }
    if (outcome->expected != 1) {
        weigh(Rgb(static_cast<float>(1 / outcome->expected)));
        // What it would carry unguided is carried by all copies.
        now_.density_ratio *= static_cast<float>(outcome->expected);
        now_.copies *= std::max(1.0f, static_cast<float>(outcome->expected));
    }
    result_.sample.branches += static_cast<std::uint32_t>(std::max(outcome->copies - 1, 0));
    for (int i = 1; i < outcome->copies; ++i) {
        now_.recorded = recorder_.branch();
        const State here = now_;
        if (draw_direction(f, directions, v, true)) {
            leave_pending();
        }
        go_on_from(here);
    }
    return outcome->copies > 0 && draw_direction(f, directions, v, true);
}

template <class Decisions, class Recorders>
template <class F, class Directions>
bool PathTracer<Decisions, Recorders>::Walk::draw_direction(const F& f, const Directions& directions, const Vertex& v,
                                                            bool judged) {
    const float u = sampler_.uniform();
    const auto s = directions.sample(u, sampler_.uniform2());
    if (!s) {
        return false;
    }
    WEND_ASSERT(s->density > 0);
    if constexpr (std::same_as<F, SurfaceScattering>) {
        if (f.reflects_or_refracts()) {
            recorder_.record(PassedBoundary{*s, v, mean_value(now_.throughput) / s->density_ratio});
        }
    }
    now_.throughput *= s->weight();
    recorder_.record(Scattered{*s, v, now_.throughput});
    remember_vertex(f, *s, v);
    if constexpr (std::same_as<Directions, InteriorWalk::Directions>) {
        now_.emitters_ahead = directions.emitter_density(s->direction) / s->density;
        recorder_.record(Turning{now_.interior});
        now_.interior.turn(directions, s->direction);
    }
    if (!judged && !survives(expected_ > 0 && !f.is_guidable())) {
        return false;
    }
    now_.ray = leave(v, s->direction);
    if (!v.in_volume()) {
        const MediumId from = std::exchange(now_.medium, medium_towards(v, s->direction)).id;
        if (now_.interior.is_inside()) {
            now_.interior.head(s->direction);
        }
        enter_medium(*v.hit, from);
    }
    now_.travelled = 0;
    return true;
}

template <class Decisions, class Recorders>
template <class F>
void PathTracer<Decisions, Recorders>::Walk::remember_vertex(const F& f, const DirectionSample& s, const Vertex& v) {
    now_.density_ratio *= s.density_ratio;
    now_.index_scale *= sqr(f.index_ratio(s.direction));
    now_.emitters_ahead = 0;
    // Connections that look through boundaries see past a refraction, to where the walk is going.
    const bool refracts = dot(now_.ray.direction, v.normal) * dot(s.direction, v.normal) > 0;
    if (s.specular && refracts && now_.last.connected_through > 0) {
        ++now_.last.refractions;
        return;
    }
    const float connected = connections(v) + now_.connected_before;
    recorder_.record(ConnectedBefore{v.in_volume() && now_.interior.is_inside() ? 1.0f
                                     : now_.connected_before > 0                ? now_.connected_before / connected
                                                                                : 0.0f});
    now_.last = {v.receiver(),
                 s.specular,
                 s.density * preference(v),
                 connected,
                 v.in_volume() ? now_.next_event.through_boundaries : 0.0f,
                 channel_probabilities(now_.throughput),
                 Rgb(1.0f),
                 s.direction,
                 now_.medium};
}

template <class Decisions, class Recorders>
bool PathTracer<Decisions, Recorders>::Walk::survives(bool is_judged_elsewhere) {
    const float survival = survival_probability(is_judged_elsewhere);
    if (survival < 1) {
        if (!(sampler_.uniform() < survival)) {
            return false;
        }
        weigh(Rgb(1 / survival));
    }
    return true;
}

}  // namespace wend
