// Next-event estimation: what a connection of a path's vertex to a light finds.
#pragma once

#include <wend/decision/channels.h>
#include <wend/decision/distance.h>
#include <wend/light/light_selection.h>
#include <wend/light/next_event.h>
#include <wend/light/specular_chain.h>
#include <wend/sampling/sampler.h>
#include <wend/scene/scene.h>
#include <wend/subsurface/interior_walk.h>
#include <wend/transport/path_state.h>
#include <wend/transport/vertex.h>

#include <optional>

namespace wend {

/// What one connection finds. All is 0 where something blocks the light.
struct Connection {
    Vec3 to_light{0, 0, 0};
    float distance = 0;        ///< infinite as well where boundaries refract
    Rgb fluence;               ///< an estimate of the light's, weighted for multiple importance sampling
    Rgb scattering;            ///< how much of it is scattered at the vertex
    bool sees_light = false;   ///< whether nothing blocks it
    float by_connections = 0;  ///< the part of connections in the density
    float from_collision = 0;  ///< and of those that began at the collision before
    std::optional<InteriorWalk> towards{};  ///< from a collision in a guided interior walk

    Rgb contribution() const { return scattering * fluence; }
};

/// Connects the vertices of a path. Each is weighed by the balance heuristic against the directions that the path might
/// have taken there.
template <DistanceDecision Distance>
class LightConnections {
public:
    /// All are referred to.
    LightConnections(const Scene& scene, const LightSelection& lights, const Distance& distance, Sampler& sampler)
        : scene_(scene), lights_(lights), distance_(distance), sampler_(sampler) {}

    /// `u` in [0,1) chooses the light, and `u2` a point of it.
    std::optional<ChosenSample> choose(const Vertex& v, float u, const Vec2& u2) const {
        return choose_light(scene_, lights_, v.receiver(), u, u2, sampler_.random());
    }

    /// Straight, in one of as many connections as `times` says, as a mean. `directions` are those of the vertex.
    template <class F, class Directions>
    Connection connect(const PathState& path, const ChosenSample& chosen, float times, const F& f,
                       const Directions& directions, const Vertex& v) const {
        const Rgb value = f.evaluate(chosen.light.direction);
        if (is_black(value)) {
            return {};
        }
        const Sight sight = look_straight(path, chosen, directions, v);
        if (is_black(sight.passage.transmittance)) {
            return {};
        }
        return weigh(path, sight, times + v.connected_before, chosen.light.point_like, value, directions, v);
    }

    /// From a collision in a dense medium, along a way that boundaries refract and that has at most so many vertices.
    template <class F, class Directions>
    Connection connect_through_boundaries(const PathState& path, const ChosenSample& chosen, float times, const F& f,
                                          const Directions& directions, const Vertex& v, int most_vertices) const {
        const auto sight = look_through_boundaries(path, chosen, directions, v, most_vertices);
        return sight ? weigh(path, *sight, times, chosen.light.point_like, f.evaluate(sight->direction), directions, v)
                     : Connection{};
    }

private:
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
    Sight look_straight(const PathState& path, const ChosenSample& chosen, const Directions& directions,
                        const Vertex& v) const {
        const LightSample& light = chosen.light;
        Sight sight{light.direction,  light.distance, light.radiance, chosen.density(), towards(directions, light.direction),
                    {}};
        const ShadowRay shadow = shadow_ray(scene_, path.leave(v, light.direction), v.position, chosen);
        sight.passage = pass(scene_, distance_, shadow, path.medium_towards(scene_, v, light.direction),
                             sight.interior ? &*sight.interior : nullptr, sampler_.random());
        return sight;
    }

    template <class Directions>
    std::optional<Sight> look_through_boundaries(const PathState& path, const ChosenSample& chosen,
                                                 const Directions& directions, const Vertex& v,
                                                 int most_vertices) const {
        const LightSample& light = chosen.light;
        const Light& source = scene_.lights()[static_cast<std::size_t>(chosen.index)];
        const auto way = find_specular_chain(scene_, {v.position, light.direction}, light.distance, path.medium);
        const bool is_far = light.distance == infinity;
        if (!way || (!is_far && way->end.light != chosen.index) || way->vertices > most_vertices) {
            return std::nullopt;
        }
        const Vec3 arriving = -way->legs().back().ray.direction;
        Sight sight{way->direction,
                    infinity,
                    is_far ? environment_radiance(source, -arriving)
                           : emitted_radiance(source, way->end.normal, arriving),
                    chosen.density() * way->density_ratio,
                    towards(directions, way->direction),
                    {}};
        sight.passage =
            pass(scene_, distance_, *way, sight.interior ? &*sight.interior : nullptr, sampler_.random());
        return sight;
    }

    /// `often`: how many connections see the light as this one does, as a mean; `value`: what is scattered here.
    template <class Directions>
    Connection weigh(const PathState& path, const Sight& sight, float often, bool point_like, const Rgb& value,
                     const Directions& directions, const Vertex& v) const {
        const float density = often * sight.density;
        float other = 0;
        if (!point_like) {
            const Rgb channels = channel_probabilities(path.weight.throughput * value);
            other = path.preference(v) * directions.density(sight.direction) * dot(channels, sight.passage.probability);
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
    const Distance& distance_;
    Sampler& sampler_;
};

}  // namespace wend
