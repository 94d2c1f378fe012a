// The random walk of a camera sample through surfaces and volumes. Every decision it takes is one of decision/, or of
// the technique that it is drawn by; the walk itself only follows rays, connects to lights, and multiplies weights.
#pragma once

#include <wend/core/contracts.h>
#include <wend/decision/channels.h>
#include <wend/light/emitter_hit.h>
#include <wend/light/light_selection.h>
#include <wend/light/scattering.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>
#include <wend/transport/branching_path.h>
#include <wend/transport/light_connections.h>
#include <wend/transport/path_decisions.h>
#include <wend/transport/path_flights.h>
#include <wend/transport/path_survival.h>
#include <wend/transport/path_technique.h>
#include <wend/transport/recorders.h>
#include <wend/transport/reflection_probability.h>
#include <wend/transport/scattering_at.h>
#include <wend/transport/subsurface_guides.h>
#include <wend/transport/surface_ahead.h>
#include <wend/transport/vertex.h>
#include <wend/transport/walk_result.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdint>
#include <optional>
#include <utility>

namespace wend {

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
    /// none. `parts` takes what it consists of, and may be null.
    WalkResult trace(const Ray& ray, float expected, Sampler& sampler, const Recorders& recorders = Recorders(),
                     LightParts* parts = nullptr) const;

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
    Walk(const PathTracer& tracer, float expected, Sampler& sampler, const Recorders& recorders, LightParts* parts)
        : tracer_(tracer),
          scene_(tracer.scene_),
          d_(tracer.decisions_),
          sampler_(sampler),
          path_(recorders, parts),
          emitters_(scene_, tracer.lights_),
          connections_(scene_, tracer.lights_, tracer.reflections_, d_, tracer.max_depth_, sampler, path_),
          flights_(scene_, d_, emitters_, sampler, path_),
          survival_(scene_, d_, expected, tracer.max_depth_, sampler, path_) {}

    WalkResult run(const Ray& start) {
        path_.start();
        path_.now.ray = start;
        path_.now.medium = scene_.medium_around(start);
        do {
            while (!is_stopped() && step()) {
            }
            path_.record(walk_events::Paused{path_.now.interior.technique});
        } while (!is_stopped() && path_.take_up_pending());
        path_.finish();
        result_.sample.radiance = path_.radiance();
        // A guided path may have gone where no other would.
        result_.unguided_square = std::isfinite(path_.unguided_square()) ? path_.unguided_square() : 0;
        return result_;
    }

private:
    bool is_stopped() const { return tracer_.stop_ && tracer_.stop_->load(std::memory_order_relaxed); }

    // ---- Flights ----

    /// One flight to the next collision, surface or interface; false where the walk ends.
    bool step() {
        ++result_.sample.segments;
        result_.interior_segments += interior_of(path_.now.interior.technique) ? 1 : 0;
        const float drawn = flights_.draw_distance();
        SurfaceAhead ahead(scene_, path_.now.ray, drawn);
        if (path_.now.medium.id != vacuum) {
            const Medium& medium = scene_.medium(path_.now.medium.id);
            const Flight flight = flights_.fly(medium, ahead, drawn);
            if (!is_black(flight.emitted)) {
                path_.glow(flight.emitted, path_.now.travelled + mean_value(flight.emitted) / flight.glow);
                path_.sort(flight.emitted, {.medium = path_.now.medium.id});
            }
            path_.weigh(flight.weight);
            path_.now.weight.density_ratio *= flight.density_ratio;
            if (is_black(path_.now.weight.throughput)) {
                return false;
            }
            if (flight.scatters) {
                path_.now.travelled += flight.distance;
                return scatter_in(medium, flight.distance);
            }
        }
        if (!ahead) {
            path_.meet(emitters_.beyond(path_.now.last, path_.now.interior.way, path_.now.ray,
                                        [&](int light, const Rgb& radiance) { path_.sort(radiance, {light}); }));
            return false;
        }
        const Hit& hit = ahead.hit();
        path_.now.travelled += hit.distance;
        if (hit.surface->view != CameraView::shown && path_.now.counts.vertices == 0) {
            path_.now.ray.pass(hit);
            return hit.surface->view == CameraView::hidden && ++path_.now.counts.interfaces < most_interfaces;
        }
        if (hit.light >= 0) {
            const EmitterHit found = emitters_.at(hit, path_.now.last, path_.now.interior.way, path_.now.ray);
            path_.meet(found);
            path_.sort(found.radiance, {hit.light});
        }
        if (scene_.is_interface(hit)) {
            const MediumId from =
                std::exchange(path_.now.medium, scene_.medium_beyond(hit, path_.now.ray.direction, path_.now.medium))
                    .id;
            path_.now.ray.pass(hit);
            path_.now.last.emitters_ahead = 0;
            // Where the medium goes on an interior walk does, as the same way through it that connections know.
            if (path_.now.medium.id != from) {
                enter_medium(hit, from);
            }
            return ++path_.now.counts.interfaces < most_interfaces;
        }
        return scatter_at(hit);
    }

    /// Chooses a technique in the medium behind a boundary, once medium and ray are those beyond it, or tells the one
    /// that goes on that it is there.
    void enter_medium(const Hit& hit, MediumId from) {
        const MediumId medium = path_.now.medium.id;
        if (medium != from && medium == hit.surface->interior) {
            if (const auto relative = scene_.relative_albedo(hit)) {
                path_.now.interior.tint = {medium, *relative};
            }
        }
        if (!hit.surface->bounds_medium() || tracer_.subsurface_.is_empty()) {
            return;
        }
        path_.record(walk_events::Paused{path_.now.interior.technique});
        if (medium != from) {
            const TechniqueMix* mix = tracer_.subsurface_.plan(medium, hit.position);
            const bool guided = mix && !(sampler_.random().uniform() < mix->unguided_probability);
            path_.record(walk_events::EnteredMedium{medium, hit.position, mix != nullptr, guided,
                                                    mix ? mix->recording_probability : 1.0f, sampler_.random()});
            path_.now.interior.next_event = !mix ? NextEventSettings{} : guided ? mix->guided : mix->unguided;
            path_.now.interior.technique = technique_of(mix, guided);
        }
        path_.ask_technique([&](auto& technique) {
            if constexpr (requires { technique.enter(tracer_.subsurface_, medium, hit, Vec3(), Rgb()); }) {
                technique.enter(tracer_.subsurface_, medium, hit, path_.now.ray.direction, path_.now.weight.throughput);
            }
        });
    }

    // ---- Vertices ----

    bool scatter_in(const Medium& medium, float distance) {
        if (path_.now.medium.id == path_.now.interior.tint.medium) {
            path_.weigh(path_.now.interior.tint.relative_albedo);
            if (is_black(path_.now.weight.throughput)) {
                return false;
            }
        }
        path_.record(walk_events::Arrived{path_.now.travelled});
        path_.now.counts.begins_in_medium |= path_.now.counts.vertices == 0;
        if (!survival_.count_vertex()) {
            return false;
        }
        const Vertex v = Vertex::in_medium(path_.now.ray.at(distance));
        const VolumeScattering f(phase_function(medium), path_.now.ray.direction);
        return path_.ask_technique([&](auto& technique) {
            const auto& directions = technique.directions(d_, f, v, path_.now.weight_to_bound(), sampler_.random());
            if constexpr (requires { directions.sample_emitters(); }) {
                connections_.connect_at_boundary(f, directions, technique, v);
            }
            return scatter(f, directions, v);
        });
    }

    bool scatter_at(const Hit& hit) {
        path_.record(walk_events::Arrived{path_.now.travelled});
        Vertex v = Vertex::on_surface(hit, path_.now.ray.direction);
        const SurfaceScattering f = scattering_at(scene_, tracer_.reflections_, path_.now, v);
        if (path_.now.last.emitters_ahead > 0) {
            v.connected_before =
                connections_.at_boundary * path_.now.last.emitters_ahead / mean_value(path_.now.last.pass_probability);
        }
        if (!survival_.count_vertex()) {
            return false;
        }
        path_.record(walk_events::HitSurface{v});
        return scatter(f, d_.direction.at(v.position, f, path_.now.weight_to_bound()), v);
    }

    /// Connects a vertex to lights, draws directions, as many as survive, and leaves all but one pending.
    template <class F, class Directions>
    bool scatter(const F& f, const Directions& directions, const Vertex& v) {
        if (!f.is_specular()) {
            connections_.connect(f, directions, v);
        }
        if (v.in_volume()) {
            connections_.connect_through_boundaries(f, directions, v);
        }
        const std::optional<WeightWindow::Outcome> outcome = d_.survival.before_direction(
            {survival_.expected_ratio(f, directions), path_.now.weight.value(), path_.split_capacity()},
            sampler_.random());
        if (!outcome) {
            return draw_direction(f, directions, v, false);
        }
        if (outcome->expected != 1) {
            path_.weigh(Rgb(static_cast<float>(1 / outcome->expected)));
            // What it would carry unguided is carried by all copies.
            path_.now.weight.density_ratio *= static_cast<float>(outcome->expected);
            path_.now.weight.copies *= std::max(1.0f, static_cast<float>(outcome->expected));
        }
        result_.sample.branches += static_cast<std::uint32_t>(std::max(outcome->copies - 1, 0));
        for (int i = 1; i < outcome->copies; ++i) {
            const auto here = path_.branch();
            if (draw_direction(f, directions, v, true)) {
                path_.leave_pending();
            }
            path_.go_on_from(here);
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
                path_.record(
                    walk_events::PassedBoundary{*s, v, mean_value(path_.now.weight.throughput) / s->density_ratio});
            }
        }
        path_.now.weight.throughput *= s->weight();
        path_.record(walk_events::Scattered{*s, v, path_.now.weight.throughput});
        remember_vertex(f, *s, v);
        if constexpr (requires { directions.emitter_density(s->direction); }) {
            path_.now.last.emitters_ahead = directions.emitter_density(s->direction) / s->density;
        }
        path_.ask_technique([&](auto& technique) {
            if constexpr (requires { technique.turn(directions, s->direction); }) {
                path_.record(walk_events::Turning{path_.now.interior.technique});
                technique.turn(directions, s->direction);
            }
        });
        survival_.count_unguided(v);
        if (!judged && !survival_.survives(f, v)) {
            return false;
        }
        const MediumState before = path_.now.medium;
        path_.now.medium = path_.now.medium_towards(scene_, v, s->direction);
        path_.now.ray = path_.now.leave(v, s->direction);
        if (!v.in_volume()) {
            path_.ask_technique([&](auto& technique) {
                if constexpr (requires { technique.head(s->direction); }) {
                    technique.head(s->direction);
                }
            });
            enter_medium(*v.hit, before.id);
        }
        path_.now.travelled = 0;
        return true;
    }

    /// What light that is met from here on will want to know.
    template <class F>
    void remember_vertex(const F& f, const DirectionSample& s, const Vertex& v) {
        path_.now.weight.density_ratio *= s.density_ratio;
        path_.now.weight.index_scale *= sqr(f.index_ratio(s.direction));
        // Connections that look through boundaries see past a refraction, to where the walk is going.
        const bool refracts = dot(path_.now.ray.direction, v.normal) * dot(s.direction, v.normal) > 0;
        WayOut& way = path_.now.interior.way;
        if (s.specular && refracts && way.connected > 0) {
            ++way.refractions;
            path_.now.last.emitters_ahead = 0;
            return;
        }
        const float connected = path_.now.connections(v) + v.connected_before;
        const bool from_itself = v.in_volume() && interior_of(path_.now.interior.technique);
        path_.record(walk_events::ConnectedBefore{from_itself              ? 1.0f
                                                  : v.connected_before > 0 ? v.connected_before / connected
                                                                           : 0.0f});
        path_.now.last = {v.receiver(),
                          s.specular,
                          s.density * path_.now.preference(v),
                          connected,
                          channel_probabilities(path_.now.weight.throughput),
                          Rgb(1.0f)};
        way = {v.in_volume() ? path_.now.interior.next_event.through_boundaries : 0.0f, 0, s.direction,
               path_.now.medium};
    }

    const PathTracer& tracer_;
    const Scene& scene_;
    const Decisions& d_;
    Sampler& sampler_;
    BranchingPath<Recorders> path_;
    EmitterHits emitters_;
    LightConnections<Decisions, Recorders> connections_;
    PathFlights<Decisions, Recorders> flights_;
    PathSurvival<Decisions, Recorders> survival_;

    WalkResult result_;
};

template <class Decisions, class Recorders>
WalkResult PathTracer<Decisions, Recorders>::trace(const Ray& ray, float expected, Sampler& sampler,
                                                   const Recorders& recorders, LightParts* parts) const {
    return Walk(*this, expected, sampler, recorders, parts).run(ray);
}

}  // namespace wend
