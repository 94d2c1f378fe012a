// Next-event estimation: what a connection of a path's vertex to a light finds.
#pragma once

#include <wend/decision/channels.h>
#include <wend/light/light_selection.h>
#include <wend/light/next_event.h>
#include <wend/light/specular_chain.h>
#include <wend/medium/transmittance.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/transport/branching_path.h>
#include <wend/transport/reflection_probability.h>
#include <wend/transport/scattering_at.h>
#include <wend/transport/vertex.h>

#include <algorithm>
#include <optional>

namespace wend {

/// What one connection finds. All is 0 where something blocks the light.
struct Connection {
    Vec3 to_light{0, 0, 0};
    float distance = 0;                     ///< infinite as well where boundaries refract
    Rgb fluence;                            ///< an estimate of the light's, weighted for multiple importance sampling
    Rgb scattering;                         ///< how much of it is scattered at the vertex
    bool sees_light = false;                ///< whether nothing blocks it
    float by_connections = 0;               ///< the part of connections in the density
    float from_collision = 0;               ///< and of those that began at the collision before
    std::optional<InteriorWalk> towards{};  ///< from a collision in a guided interior walk

    Rgb contribution() const { return scattering * fluence; }
};

/// Connects the vertices of a path. Each connection is weighed by the balance heuristic against the directions that the
/// path might have taken there.
template <class Decisions, class Recorders>
class LightConnections {
public:
    /// Connections of each flight out to a lamp (connect_at_boundary).
    static constexpr int at_boundary = 2;

    /// All but `max_depth` are referred to.
    LightConnections(const Scene& scene, const LightSelection& lights, const ReflectionProbability& reflections,
                     const Decisions& decisions, int max_depth, Sampler& sampler, BranchingPath<Recorders>& path)
        : scene_(scene),
          lights_(lights),
          reflections_(reflections),
          d_(decisions),
          max_depth_(max_depth),
          sampler_(sampler),
          path_(path) {}

    /// To lights that directions may find as well, at any vertex but a specular one.
    template <class F, class Directions>
    void connect(const F& f, const Directions& directions, const Vertex& v) {
        const float often = path_.now.connections(v);
        const bool is_left_out = often < 1 && !(sampler_.random().uniform() < often);
        if (is_left_out && !scene_.has_point_like_lights()) {
            return;
        }
        const int n = std::max(1, static_cast<int>(often));
        const float u = sampler_.uniform();
        for (int i = 0; i < n; ++i) {
            // Several go through the lights in their order.
            const auto chosen = choose(v, (static_cast<float>(i) + u) / static_cast<float>(n),
                                       i == 0 ? sampler_.uniform2() : sampler_.random().uniform2());
            if (!chosen || (is_left_out && !chosen->light.point_like)) {
                continue;
            }
            // What only connections find is never left out.
            const float times = chosen->light.point_like ? std::max(1.0f, often) : often;
            take(look(*chosen, times, f, directions, v), v, *chosen, times, false);
        }
    }

    /// The same from a collision in a dense medium, along a way that boundaries refract.
    template <class F, class Directions>
    void connect_through_boundaries(const F& f, const Directions& directions, const Vertex& v) {
        const float often = path_.now.interior.next_event.through_boundaries;
        if (often == 0 || !(sampler_.random().uniform() < often)) {
            return;
        }
        const Vec2 u2 = sampler_.random().uniform2();
        const auto chosen = choose(v, sampler_.random().uniform(), u2);
        if (!chosen || !is_seen_through_boundaries(scene_.lights()[static_cast<std::size_t>(chosen->index)])) {
            return;
        }
        take(look_refracted(*chosen, often, f, directions, v), v, *chosen, often, true);
    }

    /// What the walk would find if it flew out to a lamp from a collision and were connected at the boundary, in place
    /// of what it does find: a path either way has the same value, and the balance heuristic counts `connected_before`
    /// on both.
    template <class Directions, class Technique>
    void connect_at_boundary(const VolumeScattering& f, const Directions& directions, Technique& technique,
                             const Vertex& v) {
        if (path_.now.counts.vertices_left(max_depth_) < (scene_.counts_vertices_in(path_.now.medium.id) ? 1 : 0)) {
            return;
        }
        const std::optional<Vec3> w = directions.sample_emitters();
        const float density = w ? directions.density(*w) : 0.0f;
        if (!(density > 0)) {
            return;
        }
        const Ray ray{v.position, *w, path_.now.ray.time};
        const std::optional<Hit> hit = scene_.intersect(ray);
        if (!hit || scene_.is_interface(*hit)) {
            return;
        }
        auto here = path_.branch();
        const Rgb phase = f.evaluate(*w);
        path_.record(walk_events::Turning{path_.now.interior.technique});
        technique.turn(directions, *w);
        path_.now.ray = ray;
        const float passing = technique.pass(hit->distance);
        const Rgb arriving =
            phase * transmittance(technique.walk().guide()->medium, hit->distance) * (1 / (density * passing));
        path_.now.weight.throughput *= arriving;
        Vertex there = Vertex::on_surface(*hit, *w);
        there.connected_before = at_boundary * directions.emitter_density(*w) / (density * passing);
        const SurfaceScattering boundary = scattering_at(scene_, reflections_, path_.now, there);
        Rgb brought;
        if (is_finite(arriving) && !boundary.is_specular()) {
            constexpr int n = at_boundary;
            const auto around = d_.direction.at(there.position, boundary, path_.now.weight_to_bound());
            const float u = sampler_.random().uniform();
            for (int i = 0; i < n; ++i) {
                const auto chosen = choose(there, (static_cast<float>(i) + u) / n, sampler_.random().uniform2());
                if (!chosen) {
                    continue;
                }
                const Connection found = look(*chosen, path_.now.connections(there), boundary, around, there);
                path_.bring(path_.now.weight.throughput * found.contribution(),
                            {.from_collision = found.from_collision});
                path_.sort(found.contribution(), {chosen->index});
                brought += arriving * found.contribution();
            }
        }
        here.state.weight.unguided = path_.now.weight.unguided;
        path_.go_on_from(here);
        path_.record(walk_events::ConnectedAhead{*w, phase, brought});
    }

private:
    /// `u` in [0,1) chooses the light, and `u2` a point of it.
    std::optional<ChosenSample> choose(const Vertex& v, float u, const Vec2& u2) const {
        return choose_light(scene_, lights_, v.receiver(), u, u2, sampler_.random(), path_.now.ray.time);
    }

    /// Counts what a connection has found; as many as `times` were made, as a mean.
    void take(const Connection& found, const Vertex& v, const ChosenSample& chosen, float times,
              bool through_boundaries) {
        if (found.sees_light && v.in_volume()) {
            path_.record(walk_events::SawLight{path_.now.medium.id, through_boundaries});
        }
        const Rgb brought = found.contribution();
        path_.gather(brought, {.towards = found.towards ? &*found.towards : nullptr,
                               .by_connections = found.by_connections,
                               .from_collision = found.from_collision});
        path_.sort(brought, {chosen.index});
        path_.record(walk_events::Connected{v, chosen.index, chosen.probability, times, found.to_light, found.distance,
                                            mean_value(found.fluence), brought});
    }

    /// Straight, in one of as many connections as `times` says, as a mean. `directions` are those of the vertex.
    template <class F, class Directions>
    Connection look(const ChosenSample& chosen, float times, const F& f, const Directions& directions,
                    const Vertex& v) const {
        const Rgb value = f.evaluate(chosen.light.direction);
        if (is_black(value)) {
            return {};
        }
        const Sight sight = look_straight(chosen, directions, v);
        if (is_black(sight.passage.transmittance)) {
            return {};
        }
        return weigh(sight, times + v.connected_before, chosen.light.point_like, value, directions, v);
    }

    /// From a collision in a dense medium, along a way that boundaries refract.
    template <class F, class Directions>
    Connection look_refracted(const ChosenSample& chosen, float times, const F& f, const Directions& directions,
                              const Vertex& v) const {
        const auto sight = look_through_boundaries(chosen, directions, v);
        return sight ? weigh(*sight, times, chosen.light.point_like, f.evaluate(sight->direction), directions, v)
                     : Connection{};
    }

    /// How a vertex sees a light: where, how bright, with what density of that direction, and what is in between.
    struct Sight {
        Vec3 direction;
        float distance;
        Rgb radiance;
        float density;
        std::optional<InteriorWalk> interior;
        Passage passage;
    };

    /// The path, if it is in a guided interior walk, once it has gone from a collision in a direction.
    template <class Directions>
    static std::optional<InteriorWalk> towards(const Directions& directions, const Vec3& w) {
        if constexpr (requires { directions.towards(w); }) {
            return directions.towards(w);
        }
        return std::nullopt;
    }

    template <class Directions>
    Sight look_straight(const ChosenSample& chosen, const Directions& directions, const Vertex& v) const {
        const LightSample& light = chosen.light;
        Sight sight{light.direction,
                    light.distance,
                    light.radiance,
                    chosen.density(),
                    towards(directions, light.direction),
                    {}};
        const ShadowRay shadow = shadow_ray(scene_, path_.now.leave(v, light.direction), v.position, chosen);
        sight.passage = pass(scene_, d_.distance, shadow, path_.now.medium_towards(scene_, v, light.direction),
                             sight.interior ? &*sight.interior : nullptr, sampler_.random());
        return sight;
    }

    template <class Directions>
    std::optional<Sight> look_through_boundaries(const ChosenSample& chosen, const Directions& directions,
                                                 const Vertex& v) const {
        const LightSample& light = chosen.light;
        const Light& source = scene_.lights()[static_cast<std::size_t>(chosen.index)];
        const auto way = find_specular_chain(scene_, {v.position, light.direction, path_.now.ray.time}, light.distance,
                                             path_.now.medium);
        const bool is_far = light.distance == infinity;
        if (!way || (!is_far && way->end.light != chosen.index) ||
            way->vertices > path_.now.counts.vertices_left(max_depth_)) {
            return std::nullopt;
        }
        const Vec3 arriving = -way->legs().back().ray.direction;
        Sight sight{way->direction,
                    infinity,
                    is_far ? environment_radiance(source, way->legs().back().ray.origin, -arriving)
                           : emitted_radiance(source, way->end.normal, way->end.uv, arriving),
                    chosen.density() * way->density_ratio,
                    towards(directions, way->direction),
                    {}};
        sight.passage = pass(scene_, d_.distance, *way, sight.interior ? &*sight.interior : nullptr, sampler_.random());
        return sight;
    }

    /// `often`: how many connections see the light as this one does, as a mean; `value`: what is scattered here.
    template <class Directions>
    Connection weigh(const Sight& sight, float often, bool point_like, const Rgb& value, const Directions& directions,
                     const Vertex& v) const {
        const float density = often * sight.density;
        float other = 0;
        if (!point_like) {
            const Rgb channels = channel_probabilities(path_.now.weight.throughput * value);
            other = path_.now.preference(v) * directions.density(sight.direction) *
                    dot(channels, sight.passage.probability);
        }
        return {sight.direction,
                sight.distance,
                sight.radiance * sight.passage.transmittance * (1 / (density + other)),
                value,
                true,
                density / (density + other),
                v.connected_before * sight.density / (density + other),
                sight.interior};
    }

    const Scene& scene_;
    const LightSelection& lights_;
    const ReflectionProbability& reflections_;
    const Decisions& d_;
    int max_depth_;
    Sampler& sampler_;
    BranchingPath<Recorders>& path_;
};

}  // namespace wend
