// The walk of transport/path_tracer.h, to be included where a set of decisions is instantiated.
#pragma once

#include <wend/decision/channels.h>
#include <wend/light/emitter_hit.h>
#include <wend/light/next_event.h>
#include <wend/light/scattering.h>
#include <wend/transport/path_state.h>
#include <wend/transport/path_tracer.h>
#include <wend/transport/surface_ahead.h>
#include <wend/transport/vertex.h>

#include <algorithm>
#include <concepts>
#include <optional>
#include <utility>
#include <vector>

namespace wend {

using namespace walk_events;

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
          expected_(expected) {}

    WalkResult run(const Ray& start) {
        recorder_.start();
        now_.ray = start;
        now_.medium = scene_.camera_medium();
        do {
            while (!is_stopped() && step()) {
            }
            recorder_.record(Paused{now_.interior});
        } while (!is_stopped() && take_up_pending());
        recorder_.finish();
        result_.sample.radiance = radiance_;
        return result_;
    }

private:
    using State = PathState<typename Recorders::Branch>;

    bool is_stopped() const { return tracer_.stop_ && tracer_.stop_->load(std::memory_order_relaxed); }

    /// One flight to the next collision, surface or interface; false where the walk ends.
    bool step() {
        ++result_.sample.segments;
        // In an interior walk most flights end long before the boundary: no ray is traced further than they go.
        const float drawn = now_.interior.is_inside() ? now_.interior.draw_distance(sampler_.uniform()) : infinity;
        SurfaceAhead ahead(scene_, now_.ray, drawn);
        if (now_.medium.id != vacuum) {
            const Medium& medium = scene_.medium(now_.medium.id);
            const Flight flight = fly(medium, ahead, drawn);
            if (!is_black(flight.emitted)) {
                glow(flight.emitted, now_.travelled + mean_value(flight.emitted) / flight.glow);
            }
            weigh(flight.weight);
            now_.density_ratio *= flight.density_ratio;
            if (is_black(now_.throughput)) {
                return false;
            }
            if (flight.scatters) {
                now_.travelled += flight.distance;
                return scatter_in(medium, flight.distance);
            }
        }
        if (!ahead) {
            if (const EmitterHit arriving = emitters_.beyond(now_.last, now_.ray.direction);
                !is_black(arriving.radiance)) {
                gather(arriving.radiance, gradient_of(arriving));
            }
            return false;
        }
        const Hit& hit = ahead.hit();
        now_.travelled += hit.distance;
        if (hit.light >= 0) {
            if (const EmitterHit arriving = emitters_.at(hit, now_.last, now_.ray.direction);
                !is_black(arriving.radiance)) {
                gather(arriving.radiance, gradient_of(arriving));
            }
        }
        if (scene_.is_interface(hit)) {
            const MediumId from =
                std::exchange(now_.medium, scene_.medium_beyond(hit, now_.ray.direction, now_.medium)).id;
            now_.ray.pass(hit);
            now_.emitters_ahead = 0;
            enter_medium(hit, from);
            return ++now_.interfaces < most_interfaces;
        }
        return scatter_at(hit);
    }

    /// The next flight, up to the hit; if it passes the segment, that is counted in. In an interior walk it has been
    /// `drawn`.
    Flight fly(const Medium& medium, SurfaceAhead& ahead, float drawn) {
        const float length = ahead.distance();
        recorder_.record(Flew{now_.medium.id});
        if (now_.interior.is_inside()) {
            // Connections know the probabilities of an interior walk where they start from one of its collisions.
            const bool has_turned = now_.interior.has_turned();
            const InteriorFlight flight = now_.interior.fly(length, drawn);
            now_.last.pass_probability *=
                has_turned ? Rgb(flight.pass_probability) : d_.distance.pass_probability(medium, now_.ray, length);
            return flight.flight;
        }
        FlightStart start{now_.ray,          length, now_.throughput,
                          weight_to_bound(), {},     emitters_.in(now_.medium.id, now_.last)};
        if (d_.distance.looks_ahead(medium, start)) {
            start.end = end_of_segment(ahead);
        }
        const Flight flight = d_.distance.sample(medium, start, sampler_.uniform(), sampler_.random());
        if (!flight.scatters) {
            now_.last.pass_probability *= d_.distance.pass_probability(medium, now_.ray, length);
        }
        return flight;
    }

    /// Begins, continues or ends an interior walk in a dense medium behind a boundary, once medium and ray are those
    /// beyond it.
    void enter_medium(const Hit& hit, MediumId from);

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

    /// The ray from a vertex that the walk has just come to in a direction.
    TracedRay leave(const Vertex& v, const Vec3& w) const {
        return v.in_volume() ? TracedRay(Ray{v.position, w}) : now_.ray.leave(*v.hit, w);
    }
    /// The medium that such a ray is in.
    MediumState medium_towards(const Vertex& v, const Vec3& w) const {
        return v.in_volume() ? now_.medium : scene_.medium_beyond(*v.hit, w, now_.medium);
    }

    bool scatter_in(const Medium& medium, float distance) {
        if (now_.medium.id == now_.coloured) {
            weigh(now_.relative_albedo);
            if (is_black(now_.throughput)) {
                return false;
            }
        }
        recorder_.record(Arrived{now_.travelled});
        if (now_.depth == 0) {
            remember_first(albedo(medium), {0, 0, 0});
            result_.sample.scattered = true;
        }
        if (!count_vertex()) {
            return false;
        }
        const Vertex vertex = Vertex::in_medium(now_.ray.at(distance));
        now_.connected_before = 0;
        return scatter(VolumeScattering(phase_function(medium), now_.ray.direction), vertex);
    }

    bool scatter_at(const Hit& hit) {
        recorder_.record(Arrived{now_.travelled});
        const Vertex vertex = Vertex::on_surface(hit, now_.ray.direction);
        const SurfaceScattering f = scattering_at(vertex);
        now_.connected_before = now_.emitters_ahead > 0 ? connections_at_boundary * now_.emitters_ahead /
                                                              mean_value(now_.last.pass_probability)
                                                        : 0.0f;
        if (now_.depth == 0) {
            remember_first(f.albedo(), hit.shading.n);
        }
        if (!count_vertex()) {
            return false;
        }
        recorder_.record(HitSurface{vertex});
        return scatter(f, vertex);
    }

    /// Whether so many vertices more, that count, are not too many.
    bool has_depth_for(int vertices) const { return now_.depth - now_.uncounted + vertices <= tracer_.max_depth_; }

    /// Counts the vertex at hand in the medium at hand; false where the walk ends.
    bool count_vertex() {
        if (scene_.counts_vertices_in(now_.medium.id)) {
            const bool goes_on = has_depth_for(1);
            ++now_.depth;
            return goes_on;
        }
        ++now_.depth;
        // Through a hole in its boundary, where nothing is absorbed, a walk would never end.
        constexpr int long_walk = 10000;
        constexpr float survival = 0.9999f;
        if (++now_.uncounted <= long_walk) {
            return true;
        }
        weigh(Rgb(1 / survival));
        return sampler_.random().uniform() < survival;
    }

    SurfaceScattering scattering_at(const Vertex& v) const {
        SurfaceScattering f(scene_.bsdf(*v.hit), v.hit->shading, now_.ray.direction);
        if (f.reflects_or_refracts()) {
            f.prefer_reflection(tracer_.reflections_.odds(v.side()), weight_to_bound());
        }
        return f;
    }

    /// Connects a vertex to lights, draws a direction, and decides on survival.
    template <class F>
    bool scatter(const F& f, const Vertex& v) {
        if constexpr (F::in_volume) {
            if (now_.interior.is_inside()) {
                tracer_.subsurface_.aim(now_.medium.id, v.position, now_.interior);
                const InteriorWalk interior = now_.interior;
                const InteriorWalk::Directions directions(interior, now_.ray.direction, sampler_.random());
                connect_at_boundary(f, directions, v);
                return scatter(f, directions, v);
            }
            if (now_.is_classical) {
                return scatter(f, ClassicalDirection().at(v.position, f), v);
            }
        }
        return scatter(f, d_.direction.at(v.position, f, weight_to_bound()), v);
    }

    template <class F, class Directions>
    bool scatter(const F& f, const Directions& directions, const Vertex& v);

    /// What the walk may yet bring over what all of it is expected to, if both are known.
    template <class F, class Directions>
    std::optional<float> expected_ratio(const F& f, const Directions& directions) const {
        const std::optional<Rgb> in_scattered = directions.in_scattered();
        if (!in_scattered || !(expected_ > 0)) {
            return std::nullopt;
        }
        return mean_value(now_.throughput * f.albedo() * *in_scattered) / expected_;
    }

    float weight() const { return mean_value(now_.throughput) * now_.index_scale; }
    /// By which guided decisions are the more classical the heavier the walk is. At the boundary of a guided interior
    /// walk they are not: there connections from the collision before have to know their densities, and not the
    /// roulette since. Copies of a walk may grow as it might have, but only so many: each that has become heavy is
    /// split again, and all of them together would know no bound.
    float weight_to_bound() const {
        constexpr float free_copies = 8;
        return now_.interior.is_inside() ? 0.0f : weight() * std::max(1.0f, now_.copies / free_copies);
    }
    int split_capacity() const { return 1 + max_pending - static_cast<int>(pending_.size()); }

    void leave_pending() {
        now_.recorded = recorder_.branch();
        pending_.push_back(now_);
    }

    void go_on_from(const State& branch) {
        now_ = branch;
        recorder_.resume(now_.recorded);
    }

    bool take_up_pending() {
        if (pending_.empty()) {
            return false;
        }
        go_on_from(pending_.back());
        pending_.pop_back();
        return true;
    }

    /// Draws a direction, and decides on survival unless that has been `judged`; false where the walk ends.
    template <class F, class Directions>
    bool draw_direction(const F& f, const Directions& directions, const Vertex& v, bool judged);
    /// What light that is met from here on will want to know.
    template <class F>
    void remember_vertex(const F& f, const DirectionSample& s, const Vertex& v);
    /// Roulette after the direction is drawn.
    bool survives(bool is_judged_elsewhere);

    /// What multiplies the density of the walk's own directions where it is weighed against that of connections to
    /// lights.
    float preference(const Vertex& v) const { return v.in_volume() ? now_.next_event.preference : 1.0f; }

    /// To lights that directions find as well, as a mean.
    float connections(const Vertex& v) const {
        return v.in_volume() ? now_.next_event.probability : static_cast<float>(now_.next_event.at_surfaces);
    }

    float survival_probability(bool is_judged_elsewhere) {
        const WalkState state{now_.throughput, now_.density_ratio, now_.index_scale, now_.depth, is_judged_elsewhere};
        return now_.interior.is_inside() && !is_judged_elsewhere
                   ? now_.interior.survival(max_value(now_.throughput) * now_.index_scale)
                   : d_.survival.after_direction(state);
    }

    /// What one connection to one light finds: its direction, an estimate of the light's fluence, weighted for multiple
    /// importance sampling, and how much of it is scattered here.
    struct Connection {
        Vec3 to_light{0, 0, 0};
        float distance = 0;
        Rgb light;
        Rgb scattering;
        std::optional<MixGradient> slope;  ///< during an interior walk
    };

    template <class F, class Directions>
    void connect_to_lights(const F& f, const Directions& directions, const Vertex& v);
    /// The same from a collision in a dense medium, along a way that boundaries refract.
    template <class F, class Directions>
    void connect_through_boundaries(const F& f, const Directions& directions, const Vertex& v);
    /// Counts what a connection has found; as many as `times` were made, as a mean.
    void take(const Connection& found, const Vertex& v, const ChosenSample& chosen, float times);
    /// Flies out from a collision in an interior walk to a lamp that is known there, and connects the boundary to
    /// lights.
    void connect_at_boundary(const VolumeScattering& f, const InteriorWalk::Directions& directions, const Vertex& v);
    template <class F, class Directions>
    Connection connect(const ChosenSample& chosen, float times, const F& f, const Directions& directions,
                       const Vertex& v);
    /// How a vertex sees a light: where, how bright, with what density of that direction, and what is in between.
    struct Sight {
        Vec3 direction;
        float distance;  ///< infinity as well where boundaries refract
        Rgb radiance;
        float density;
        InteriorWalk interior;  ///< towards the light, in a guided interior walk
        Passage passage;
    };
    /// `often`: how many connections see the light as this one does, as a mean; `value`: what is scattered here.
    template <class Directions>
    Connection weigh(const Sight& sight, float often, bool point_like, const Rgb& value, const Directions& directions,
                     const Vertex& v) const;
    template <class Directions>
    Sight look_straight(const ChosenSample& chosen, const Directions& directions, const Vertex& v);
    template <class Directions>
    std::optional<Sight> look_through_boundaries(const ChosenSample& chosen, const Directions& directions,
                                                 const Vertex& v);
    /// The walk, if it is in a guided interior walk, after it went from a collision in a direction.
    template <class Directions>
    InteriorWalk interior_towards(const Vec3& direction, const Directions& directions) const;
    void remember_first(const Rgb& surface_albedo, const Vec3& normal) {
        result_.sample.albedo = surface_albedo;
        result_.sample.normal = normal;
        result_.sample.depth = now_.travelled;
    }

    std::optional<MixGradient> gradient_of(const EmitterHit& arriving) {
        return recorder_.template get<InteriorRecorder>().gradient_of(arriving, now_.last, now_.interior);
    }

    // What the walk multiplies and adds.
    void weigh(const Rgb& weight) {
        now_.throughput *= weight;
        recorder_.record(Weighed{weight});
    }
    void gather(const Rgb& radiance, const std::optional<MixGradient>& slope = {}) {
        bring(now_.throughput * radiance, slope);
        recorder_.record(MetLight{radiance});
    }
    void glow(const Rgb& radiance, float distance) {
        bring(now_.throughput * radiance, {});
        recorder_.record(MetEmission{radiance, distance});
    }
    void bring(const Rgb& light, const std::optional<MixGradient>& slope) {
        radiance_ += light;
        recorder_.record(Contributed{mean_value(light), slope, now_.interior});
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

    State now_;
    std::vector<State> pending_;
    Rgb radiance_;
    float expected_;

    WalkResult result_;
};

}  // namespace wend

#include <wend/transport/path_tracer_directions.inl>
#include <wend/transport/path_tracer_interior.inl>
#include <wend/transport/path_tracer_next_event.inl>

namespace wend {

template <class Decisions, class Recorders>
WalkResult PathTracer<Decisions, Recorders>::trace(const Ray& ray, float expected, Sampler& sampler,
                                                   const Recorders& recorders) const {
    return Walk(*this, expected, sampler, recorders).run(ray);
}

}  // namespace wend
