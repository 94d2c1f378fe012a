// The random walk of a camera sample through surfaces and volumes. Every decision it takes is one of decision/, or of the
// technique that it is drawn by; the walk itself only follows rays, connects to lights, and multiplies weights.
#pragma once

#include <wend/core/contracts.h>
#include <wend/decision/channels.h>
#include <wend/decision/direction.h>
#include <wend/decision/guided_distance.h>
#include <wend/decision/roulette_splitting.h>
#include <wend/film/film.h>
#include <wend/light/emitter_hit.h>
#include <wend/light/light_selection.h>
#include <wend/light/scattering.h>
#include <wend/medium/transmittance.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>
#include <wend/transport/light_connections.h>
#include <wend/transport/path_state.h>
#include <wend/transport/path_technique.h>
#include <wend/transport/recorders.h>
#include <wend/transport/reflection_probability.h>
#include <wend/transport/subsurface_guides.h>
#include <wend/transport/surface_ahead.h>
#include <wend/transport/vertex.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

namespace wend {

/// Counted work of walks.
struct WalkCounts {
    std::uint64_t paths = 0;
    std::uint64_t segments = 0;
    std::uint64_t rejected = 0;

    WalkCounts& operator+=(const WalkCounts& o) {
        paths += o.paths;
        segments += o.segments;
        rejected += o.rejected;
        return *this;
    }
};

/// What a walk found. The radiance may be not finite: the caller counts and rejects.
struct WalkResult {
    FilmSample sample;
};

/// The decisions of a walk, as a bundle of values.
template <class D>
concept WalkDecisions = requires(const D& d) {
    requires DistanceDecision<decltype(d.distance)>;
    requires RouletteSplittingDecision<decltype(d.survival)>;
    d.direction;
};

struct ClassicalDecisions {
    ClassicalDistance distance;
    ClassicalDirection direction;
    ClassicalRoulette survival;
};

template <class Field, class Distance, class Survival>
struct GuidedDecisions {
    Distance distance;
    GuidedDirection<Field> direction;
    Survival survival;
};
// C++20 deduces this by itself, but clang only from version 17 on.
template <class Field, class Distance, class Survival>
GuidedDecisions(Distance, GuidedDirection<Field>, Survival) -> GuidedDecisions<Field, Distance, Survival>;

/// Walks through a scene with given decisions, seen by given recorders: at least those of StandardRecorders. A vertex
/// is a scattering event: interfaces are passed for free.
template <class Decisions, class Recorders = StandardRecorders>
class PathTracer {
public:
    /// All but `max_depth`, the largest number of vertices (pbrt's maxdepth), are referred to. Walks end as they are
    /// once `stop` is true, which may be null.
    PathTracer(const Scene& scene, const Decisions& decisions, const SubsurfaceGuides& subsurface,
               const LightSelection& lights, const ReflectionProbability& reflections, int max_depth,
               const std::atomic<bool>* stop = nullptr)
        : scene_(scene),
          decisions_(decisions),
          subsurface_(subsurface),
          lights_(lights),
          reflections_(reflections),
          max_depth_(max_depth),
          stop_(stop) {}

    /// Radiance arriving along the ray, of which `expected` is an estimate for decisions on survival; 0 where there is
    /// none.
    WalkResult trace(const Ray& ray, float expected, Sampler& sampler, const Recorders& recorders = Recorders()) const;

private:
    class Walk;

    const Scene& scene_;
    const Decisions& decisions_;
    const SubsurfaceGuides& subsurface_;
    const LightSelection& lights_;
    const ReflectionProbability& reflections_;
    int max_depth_;
    const std::atomic<bool>* stop_;
};

template <class Decisions, class Recorders>
class PathTracer<Decisions, Recorders>::Walk {
public:
    Walk(const PathTracer& tracer, float expected, Sampler& sampler, const Recorders& recorders)
        : tracer_(tracer),
          scene_(tracer.scene_),
          d_(tracer.decisions_),
          sampler_(sampler),
          recorder_(recorders),
          emitters_(scene_, tracer.lights_),
          connections_(scene_, tracer.lights_, d_.distance, sampler),
          expected_(expected) {}

    WalkResult run(const Ray& start) {
        recorder_.start();
        now_.ray = start;
        now_.medium = scene_.camera_medium();
        do {
            while (!is_stopped() && step()) {
            }
            recorder_.record(walk_events::Paused{now_.technique});
        } while (!is_stopped() && take_up_pending());
        recorder_.finish();
        result_.sample.radiance = radiance_;
        return result_;
    }

private:
    bool is_stopped() const { return tracer_.stop_ && tracer_.stop_->load(std::memory_order_relaxed); }

    // ---- Flights ----

    /// One flight to the next collision, surface or interface; false where the walk ends.
    bool step() {
        ++result_.sample.segments;
        const float drawn = ask_technique(
            [&](auto& technique) -> float {
                if constexpr (requires { technique.draw_distance(sampler_); }) {
                    return technique.draw_distance(sampler_);
                }
                return infinity;
            });
        SurfaceAhead ahead(scene_, now_.ray, drawn);
        if (now_.medium.id != vacuum) {
            const Medium& medium = scene_.medium(now_.medium.id);
            const Flight flight = fly(medium, ahead, drawn);
            if (!is_black(flight.emitted)) {
                glow(flight.emitted, now_.travelled + mean_value(flight.emitted) / flight.glow);
            }
            weigh(flight.weight);
            now_.weight.density_ratio *= flight.density_ratio;
            if (is_black(now_.weight.throughput)) {
                return false;
            }
            if (flight.scatters) {
                now_.travelled += flight.distance;
                return scatter_in(medium, flight.distance);
            }
        }
        if (!ahead) {
            meet(emitters_.beyond(now_.last, now_.ray.direction));
            return false;
        }
        const Hit& hit = ahead.hit();
        now_.travelled += hit.distance;
        if (hit.light >= 0) {
            meet(emitters_.at(hit, now_.last, now_.ray.direction));
        }
        if (scene_.is_interface(hit)) {
            const MediumId from =
                std::exchange(now_.medium, scene_.medium_beyond(hit, now_.ray.direction, now_.medium)).id;
            now_.ray.pass(hit);
            now_.last.emitters_ahead = 0;
            enter_medium(hit, from);
            return ++now_.counts.interfaces < most_interfaces;
        }
        return scatter_at(hit);
    }

    /// The next flight, up to the surface ahead; if it passes the segment, that is counted in.
    Flight fly(const Medium& medium, SurfaceAhead& ahead, float drawn) {
        const float length = ahead.distance();
        recorder_.record(walk_events::Flew{now_.medium.id});
        const TechniqueFlight flight = ask_technique(
            [&](auto& technique) -> TechniqueFlight {
                if constexpr (requires { technique.fly(length, drawn); }) {
                    return technique.fly(length, drawn);
                }
                return {fly_by_decision(medium, ahead, length), std::nullopt};
            });
        if (!flight.flight.scatters) {
            now_.last.pass_probability *= flight.pass_probability
                                              ? Rgb(*flight.pass_probability)
                                              : d_.distance.pass_probability(medium, now_.ray, length);
        }
        return flight.flight;
    }

    Flight fly_by_decision(const Medium& medium, SurfaceAhead& ahead, float length) {
        FlightStart start{now_.ray,          length, now_.weight.throughput,
                          weight_to_bound(), {},     emitters_.in(now_.medium.id, now_.last)};
        if (d_.distance.looks_ahead(medium, start)) {
            start.end = end_of_segment(ahead);
        }
        return d_.distance.sample(medium, start, sampler_.uniform(), sampler_.random());
    }

    FlightEnd end_of_segment(SurfaceAhead& ahead) const {
        FlightEnd end;
        if (!ahead) {
            end.emitted = mean_value(emitters_.beyond(now_.last, now_.ray.direction).radiance);
            return end;
        }
        const Hit& hit = ahead.hit();
        end.kind = scene_.is_interface(hit) ? FlightEnd::Kind::interface : FlightEnd::Kind::surface;
        end.position = hit.position;
        end.normal = Vertex::facing_normal(hit, now_.ray.direction);
        end.emitted = hit.light >= 0 ? mean_value(emitters_.at(hit, now_.last, now_.ray.direction).radiance) : 0.0f;
        return end;
    }

    /// Chooses a technique in the medium behind a boundary, once medium and ray are those beyond it, or tells the one
    /// that goes on that it is there.
    void enter_medium(const Hit& hit, MediumId from) {
        const MediumId medium = now_.medium.id;
        if (medium != from && medium == hit.surface->interior) {
            if (const auto relative = scene_.relative_albedo(hit)) {
                now_.tint = {medium, *relative};
            }
        }
        if (!hit.surface->bounds_medium() || tracer_.subsurface_.is_empty()) {
            return;
        }
        recorder_.record(walk_events::Paused{now_.technique});
        if (medium != from) {
            const TechniqueMix* mix = tracer_.subsurface_.plan(medium, hit.position);
            const bool guided = mix && !(sampler_.random().uniform() < mix->unguided_probability);
            recorder_.record(walk_events::EnteredMedium{medium, hit.position, mix != nullptr, guided,
                                                        mix ? mix->recording_probability : 1.0f, sampler_.random()});
            now_.next_event = !mix ? NextEventSettings{} : guided ? mix->guided : mix->unguided;
            now_.technique = technique_of(mix, guided);
        }
        ask_technique([&](auto& technique) {
            if constexpr (requires { technique.enter(tracer_.subsurface_, medium, hit, Vec3(), Rgb()); }) {
                technique.enter(tracer_.subsurface_, medium, hit, now_.ray.direction, now_.weight.throughput);
            }
        });
    }

    // ---- Vertices ----

    bool scatter_in(const Medium& medium, float distance) {
        if (now_.medium.id == now_.tint.medium) {
            weigh(now_.tint.relative_albedo);
            if (is_black(now_.weight.throughput)) {
                return false;
            }
        }
        recorder_.record(walk_events::Arrived{now_.travelled});
        if (now_.counts.vertices == 0) {
            remember_first(albedo(medium), {0, 0, 0});
            result_.sample.scattered = true;
        }
        if (!count_vertex()) {
            return false;
        }
        const Vertex v = Vertex::in_medium(now_.ray.at(distance));
        const VolumeScattering f(phase_function(medium), now_.ray.direction);
        return ask_technique([&](auto& technique) {
            const auto& directions = technique.directions(d_, f, v, weight_to_bound(), sampler_.random());
            if constexpr (requires { directions.sample_emitters(); }) {
                connect_at_boundary(f, directions, technique, v);
            }
            return scatter(f, directions, v);
        });
    }

    bool scatter_at(const Hit& hit) {
        recorder_.record(walk_events::Arrived{now_.travelled});
        Vertex v = Vertex::on_surface(hit, now_.ray.direction);
        const SurfaceScattering f = scattering_at(v);
        if (now_.last.emitters_ahead > 0) {
            v.connected_before =
                connections_at_boundary * now_.last.emitters_ahead / mean_value(now_.last.pass_probability);
        }
        if (now_.counts.vertices == 0) {
            remember_first(f.albedo(), hit.shading.n);
        }
        if (!count_vertex()) {
            return false;
        }
        recorder_.record(walk_events::HitSurface{v});
        return scatter(f, d_.direction.at(v.position, f, weight_to_bound()), v);
    }

    SurfaceScattering scattering_at(const Vertex& v) const {
        SurfaceScattering f(scene_.bsdf(*v.hit), v.hit->shading, now_.ray.direction);
        if (f.reflects_or_refracts()) {
            f.prefer_reflection(tracer_.reflections_.odds(v.side()), weight_to_bound());
        }
        return f;
    }

    /// Connects a vertex to lights, draws directions, as many as survive, and leaves all but one pending.
    template <class F, class Directions>
    bool scatter(const F& f, const Directions& directions, const Vertex& v) {
        if (!f.is_specular()) {
            connect_to_lights(f, directions, v);
        }
        if (v.in_volume()) {
            connect_through_boundaries(f, directions, v);
        }
        const std::optional<WeightWindow::Outcome> outcome = d_.survival.before_direction(
            {expected_ratio(f, directions), now_.weight.value(), split_capacity()}, sampler_.random());
        if (!outcome) {
            return draw_direction(f, directions, v, false);
        }
        if (outcome->expected != 1) {
            weigh(Rgb(static_cast<float>(1 / outcome->expected)));
            // What it would carry unguided is carried by all copies.
            now_.weight.density_ratio *= static_cast<float>(outcome->expected);
            now_.weight.copies *= std::max(1.0f, static_cast<float>(outcome->expected));
        }
        result_.sample.branches += static_cast<std::uint32_t>(std::max(outcome->copies - 1, 0));
        for (int i = 1; i < outcome->copies; ++i) {
            const Branch here = branch();
            if (draw_direction(f, directions, v, true)) {
                pending_.push_back(branch());
            }
            go_on_from(here);
        }
        return outcome->copies > 0 && draw_direction(f, directions, v, true);
    }

    /// Draws a direction, and decides on survival unless that has been `judged`; false where the walk ends.
    template <class F, class Directions>
    bool draw_direction(const F& f, const Directions& directions, const Vertex& v, bool judged) {
        const float u = sampler_.uniform();
        const auto s = directions.sample(u, sampler_.uniform2());
        if (!s) {
            return false;
        }
        WEND_ASSERT(s->density > 0);
        if constexpr (requires { f.reflects_or_refracts(); }) {
            if (f.reflects_or_refracts()) {
                recorder_.record(
                    walk_events::PassedBoundary{*s, v, mean_value(now_.weight.throughput) / s->density_ratio});
            }
        }
        now_.weight.throughput *= s->weight();
        recorder_.record(walk_events::Scattered{*s, v, now_.weight.throughput});
        remember_vertex(f, *s, v);
        if constexpr (requires { directions.emitter_density(s->direction); }) {
            now_.last.emitters_ahead = directions.emitter_density(s->direction) / s->density;
        }
        ask_technique([&](auto& technique) {
            if constexpr (requires { technique.turn(directions, s->direction); }) {
                recorder_.record(walk_events::Turning{now_.technique});
                technique.turn(directions, s->direction);
            }
        });
        if (!judged && !survives(expected_ > 0 && !f.is_guidable())) {
            return false;
        }
        const MediumState before = now_.medium;
        now_.medium = now_.medium_towards(scene_, v, s->direction);
        now_.ray = now_.leave(v, s->direction);
        if (!v.in_volume()) {
            ask_technique([&](auto& technique) {
                if constexpr (requires { technique.head(s->direction); }) {
                    technique.head(s->direction);
                }
            });
            enter_medium(*v.hit, before.id);
        }
        now_.travelled = 0;
        return true;
    }

    /// What light that is met from here on will want to know.
    template <class F>
    void remember_vertex(const F& f, const DirectionSample& s, const Vertex& v) {
        now_.weight.density_ratio *= s.density_ratio;
        now_.weight.index_scale *= sqr(f.index_ratio(s.direction));
        // Connections that look through boundaries see past a refraction, to where the walk is going.
        const bool refracts = dot(now_.ray.direction, v.normal) * dot(s.direction, v.normal) > 0;
        if (s.specular && refracts && now_.last.connected_through > 0) {
            ++now_.last.refractions;
            now_.last.emitters_ahead = 0;
            return;
        }
        const float connected = now_.connections(v) + v.connected_before;
        const bool from_itself = v.in_volume() && interior_of(now_.technique);
        recorder_.record(walk_events::ConnectedBefore{from_itself              ? 1.0f
                                                      : v.connected_before > 0 ? v.connected_before / connected
                                                                               : 0.0f});
        now_.last = {v.receiver(),
                     s.specular,
                     s.density * now_.preference(v),
                     connected,
                     v.in_volume() ? now_.next_event.through_boundaries : 0.0f,
                     channel_probabilities(now_.weight.throughput),
                     Rgb(1.0f),
                     s.direction,
                     now_.medium};
    }

    // ---- Connections to lights ----

    template <class F, class Directions>
    void connect_to_lights(const F& f, const Directions& directions, const Vertex& v) {
        const float often = now_.connections(v);
        const bool is_left_out = often < 1 && !(sampler_.random().uniform() < often);
        if (is_left_out && !scene_.has_point_like_lights()) {
            return;
        }
        const int n = std::max(1, static_cast<int>(often));
        const float u = sampler_.uniform();
        for (int i = 0; i < n; ++i) {
            // Several go through the lights in their order.
            const auto chosen = connections_.choose(v, (static_cast<float>(i) + u) / static_cast<float>(n),
                                                    i == 0 ? sampler_.uniform2() : sampler_.random().uniform2());
            if (!chosen || (is_left_out && !chosen->light.point_like)) {
                continue;
            }
            // What only connections find is never left out.
            const float times = chosen->light.point_like ? std::max(1.0f, often) : often;
            take(connections_.connect(now_, *chosen, times, f, directions, v), v, *chosen, times, false);
        }
    }

    /// The same from a collision in a dense medium, along a way that boundaries refract.
    template <class F, class Directions>
    void connect_through_boundaries(const F& f, const Directions& directions, const Vertex& v) {
        const float often = now_.next_event.through_boundaries;
        if (often == 0 || !(sampler_.random().uniform() < often)) {
            return;
        }
        const Vec2 u2 = sampler_.random().uniform2();
        const auto chosen = connections_.choose(v, sampler_.random().uniform(), u2);
        if (!chosen || !is_seen_through_boundaries(scene_.lights()[static_cast<std::size_t>(chosen->index)])) {
            return;
        }
        take(connections_.connect_through_boundaries(now_, *chosen, often, f, directions, v, vertices_left()), v,
             *chosen, often, true);
    }

    /// Counts what a connection has found; as many as `times` were made, as a mean.
    void take(const Connection& found, const Vertex& v, const ChosenSample& chosen, float times,
              bool through_boundaries) {
        if (found.sees_light && v.in_volume()) {
            recorder_.record(walk_events::SawLight{now_.medium.id, through_boundaries});
        }
        const Rgb brought = found.contribution();
        gather(brought, {.towards = found.towards ? &*found.towards : nullptr,
                         .by_connections = found.by_connections,
                         .from_collision = found.from_collision});
        recorder_.record(walk_events::Connected{v, chosen.index, chosen.probability, times, found.to_light,
                                                found.distance, mean_value(found.fluence), brought});
    }

    // What the walk would find if it flew out to a lamp from a collision and were connected at the boundary, in place of
    // what it does find: a path either way has the same value, and the balance heuristic counts `connected_before` on
    // both.
    template <class Directions, class Technique>
    void connect_at_boundary(const VolumeScattering& f, const Directions& directions, Technique& technique,
                             const Vertex& v) {
        if (vertices_left() < (scene_.counts_vertices_in(now_.medium.id) ? 1 : 0)) {
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
        const Branch here = branch();
        const Rgb phase = f.evaluate(*w);
        recorder_.record(walk_events::Turning{now_.technique});
        technique.turn(directions, *w);
        now_.ray = ray;
        const float passing = technique.pass(hit->distance);
        const Rgb arriving =
            phase * transmittance(technique.walk().guide()->medium, hit->distance) * (1 / (density * passing));
        now_.weight.throughput *= arriving;
        Vertex there = Vertex::on_surface(*hit, *w);
        there.connected_before = connections_at_boundary * directions.emitter_density(*w) / (density * passing);
        const SurfaceScattering boundary = scattering_at(there);
        Rgb brought;
        if (is_finite(arriving) && !boundary.is_specular()) {
            constexpr int n = connections_at_boundary;
            const auto around = d_.direction.at(there.position, boundary, weight_to_bound());
            const float u = sampler_.random().uniform();
            for (int i = 0; i < n; ++i) {
                const auto chosen =
                    connections_.choose(there, (static_cast<float>(i) + u) / n, sampler_.random().uniform2());
                if (!chosen) {
                    continue;
                }
                const Connection found =
                    connections_.connect(now_, *chosen, now_.connections(there), boundary, around, there);
                bring(now_.weight.throughput * found.contribution(), {.from_collision = found.from_collision});
                brought += arriving * found.contribution();
            }
        }
        go_on_from(here);
        recorder_.record(walk_events::ConnectedAhead{*w, phase, brought});
    }

    // ---- Whether to go on ----

    /// How many vertices more, that count, are not too many.
    int vertices_left() const { return tracer_.max_depth_ - (now_.counts.vertices - now_.counts.uncounted); }

    /// Counts the vertex at hand in the medium at hand; false where the walk ends.
    bool count_vertex() {
        if (scene_.counts_vertices_in(now_.medium.id)) {
            const bool goes_on = vertices_left() >= 1;
            ++now_.counts.vertices;
            return goes_on;
        }
        ++now_.counts.vertices;
        // Through a hole in its boundary, where nothing is absorbed, a walk would never end.
        constexpr int long_walk = 10000;
        constexpr float survival = 0.9999f;
        if (++now_.counts.uncounted <= long_walk) {
            return true;
        }
        weigh(Rgb(1 / survival));
        return sampler_.random().uniform() < survival;
    }

    /// What the walk may yet bring over what all of it is expected to, if both are known.
    template <class F, class Directions>
    std::optional<float> expected_ratio(const F& f, const Directions& directions) const {
        const std::optional<Rgb> in_scattered = directions.in_scattered();
        if (!in_scattered || !(expected_ > 0)) {
            return std::nullopt;
        }
        return mean_value(now_.weight.throughput * f.albedo() * *in_scattered) / expected_;
    }

    /// Roulette after the direction is drawn.
    bool survives(bool is_judged_elsewhere) {
        const float survival = survival_probability(is_judged_elsewhere);
        if (survival < 1) {
            if (!(sampler_.uniform() < survival)) {
                return false;
            }
            weigh(Rgb(1 / survival));
        }
        return true;
    }

    float survival_probability(bool is_judged_elsewhere) {
        const PathWeight& weight = now_.weight;
        return ask_technique([&](auto& technique) {
            if constexpr (requires { technique.survival(0.0f); }) {
                if (!is_judged_elsewhere) {
                    return technique.survival(max_value(weight.throughput) * weight.index_scale);
                }
            }
            return d_.survival.after_direction({weight.throughput, weight.density_ratio, weight.index_scale,
                                                now_.counts.vertices, is_judged_elsewhere});
        });
    }

    /// By which guided decisions are the more classical the heavier the walk is. Where the technique bounds its own
    /// weights they are not: at the boundary of an interior walk connections from the collision before have to know
    /// their densities, and not the roulette since. Copies of a walk may grow as it might have, but only so many: each
    /// that has become heavy is split again, and all of them together would know no bound.
    float weight_to_bound() const {
        constexpr float free_copies = 8;
        const bool is_bounded = std::visit(
            [](const auto& technique) { return requires { technique.bounds_weights; }; }, now_.technique);
        return is_bounded ? 0.0f : now_.weight.value() * std::max(1.0f, now_.weight.copies / free_copies);
    }

    // ---- Branches ----

    struct Branch {
        PathState state;
        typename Recorders::Branch recorded;
    };
    Branch branch() const { return {now_, recorder_.branch()}; }
    void go_on_from(const Branch& branch) {
        now_ = branch.state;
        recorder_.resume(branch.recorded);
    }
    bool take_up_pending() {
        if (pending_.empty()) {
            return false;
        }
        go_on_from(pending_.back());
        pending_.pop_back();
        return true;
    }
    int split_capacity() const { return 1 + max_pending - static_cast<int>(pending_.size()); }

    /// What the technique at hand says.
    template <class Question>
    decltype(auto) ask_technique(Question&& question) {
        return std::visit(question, now_.technique);
    }

    // ---- What the walk multiplies and adds ----

    void remember_first(const Rgb& surface_albedo, const Vec3& normal) {
        result_.sample.albedo = surface_albedo;
        result_.sample.normal = normal;
        result_.sample.depth = now_.travelled;
    }
    void weigh(const Rgb& weight) {
        now_.weight.throughput *= weight;
        recorder_.record(walk_events::Weighed{weight});
    }
    /// Light that the walk runs into.
    void meet(const EmitterHit& hit) {
        if (!is_black(hit.radiance)) {
            gather(hit.radiance, {.hit = &hit, .last = &now_.last});
        }
    }
    void gather(const Rgb& radiance, const walk_events::LightFound& found) {
        bring(now_.weight.throughput * radiance, found);
        recorder_.record(walk_events::MetLight{radiance});
    }
    void glow(const Rgb& radiance, float distance) {
        bring(now_.weight.throughput * radiance, {});
        recorder_.record(walk_events::MetEmission{radiance, distance});
    }
    void bring(const Rgb& light, const walk_events::LightFound& found) {
        radiance_ += light;
        recorder_.record(walk_events::Contributed{mean_value(light), now_.technique, found});
    }

    static constexpr int max_pending = 64;
    /// For each flight out to a lamp.
    static constexpr int connections_at_boundary = 2;

    const PathTracer& tracer_;
    const Scene& scene_;
    const Decisions& d_;
    Sampler& sampler_;
    Recorders recorder_;
    EmitterHits emitters_;
    LightConnections<decltype(Decisions::distance)> connections_;

    PathState now_;
    std::vector<Branch> pending_;
    Rgb radiance_;
    float expected_;

    WalkResult result_;
};

template <class Decisions, class Recorders>
WalkResult PathTracer<Decisions, Recorders>::trace(const Ray& ray, float expected, Sampler& sampler,
                                                   const Recorders& recorders) const {
    return Walk(*this, expected, sampler, recorders).run(ray);
}

}  // namespace wend
