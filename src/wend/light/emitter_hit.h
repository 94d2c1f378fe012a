// Light that a walk runs into, weighted against the connections that could have found it.
#pragma once

#include <wend/decision/channels.h>
#include <wend/decision/distance.h>
#include <wend/light/light_selection.h>
#include <wend/light/specular_chain.h>
#include <wend/scene/scene.h>

namespace wend {

/// The last vertex of a walk and the way from there, as multiple importance sampling wants it.
struct LastVertex {
    LightReceiver receiver{};
    /// Whether nothing was connected to lights there: before the first vertex, and after a mirror.
    bool unconnected = true;
    /// Of the direction drawn there, per steradian, times what it counts for against connections; 0 before the first
    /// vertex.
    float density = 0;
    /// How often it was connected along straight lines, as a mean.
    float connected = 1;
    /// Probabilities of the walk's colour channels, and under each of them of flying as far as the walk has.
    Rgb channels;
    Rgb pass_probability;
    /// Of the direction drawn there: the density of connections at the boundary ahead, over its own.
    float emitters_ahead = 0;

    bool has_scattered() const { return density > 0; }
    float own_density() const { return density * dot(channels, pass_probability); }
};

/// The way from the last vertex out of a medium, where boundaries refract it.
struct WayOut {
    /// How often the vertex was connected along such ways, as a mean: only collisions in dense media are.
    float connected = 0;
    /// How often the walk was refracted since, where it met nothing else.
    int refractions = 0;
    /// The direction drawn there, and in which medium that is.
    Vec3 direction{0, 0, 1};
    MediumState medium;
};

/// Light with its weight of multiple importance sampling.
struct EmitterHit {
    Rgb radiance;
    float by_connections = 0;  ///< the same, the part left to connections

    void add(const Rgb& emitted, float weight) {
        radiance += emitted * weight;
        by_connections += mean_value(emitted) * weight * (1 - weight);
    }
};

/// Answers for walks that go from a last vertex into a direction.
class EmitterHits {
public:
    EmitterHits(const Scene& scene, const LightSelection& choices) : scene_(scene), choices_(choices) {}

    /// Of a surface that shines.
    EmitterHit at(const Hit& hit, const LastVertex& last, const WayOut& way, const Ray& ray) const {
        EmitterHit arriving;
        const Light& light = scene_.lights()[static_cast<std::size_t>(hit.light)];
        Rgb emitted = emitted_radiance(light, hit.normal, hit.uv, -ray.direction);
        if ((last.unconnected || way.refractions > 0) && presence_of(light) == Presence::partly) {
            // As pbrt has it: where a lamp is partly there, a ray that has met it may yet find it dark. No connection
            // looks for such a lamp through boundaries.
            emitted *= scene_.presence(hit.light, texture_point(hit));
        }
        if (!is_black(emitted)) {
            arriving.add(emitted, weight(hit.light, last, way, ray, hit.position, hit.normal));
        }
        return arriving;
    }

    /// From beyond the scene, as seen from where the walk has turned last.
    EmitterHit beyond(const LastVertex& last, const WayOut& way, const TracedRay& ray) const {
        return beyond(last, way, ray, [](int, const Rgb&) {});
    }
    /// The same; `each` is told what comes from each light.
    template <class Each>
    EmitterHit beyond(const LastVertex& last, const WayOut& way, const TracedRay& ray, const Each& each) const {
        EmitterHit arriving;
        for (const int light : scene_.infinite_lights()) {
            const Rgb emitted =
                environment_radiance(scene_.light_at_infinity(light, last.has_scattered()), ray.start(), ray.direction);
            if (!is_black(emitted)) {
                const float w = weight(light, last, way, ray, {}, {});
                arriving.add(emitted, w);
                each(light, emitted * w);
            }
        }
        return arriving;
    }

    /// What a flight through a medium may keep of its light.
    EmissionShare in(MediumId medium, const LastVertex& last, const WayOut& way) const {
        const int light = scene_.medium_light(medium);
        if (light < 0 || last.unconnected || way.refractions > 0) {
            return {};
        }
        return {std::get<MediumLight>(scene_.lights()[static_cast<std::size_t>(light)]).grid->glow(),
                last.receiver.position, last.own_density(),
                last.connected * choices_.probability(last.receiver, light)};
    }

private:
    float weight(int light, const LastVertex& last, const WayOut& way, const Ray& ray, const Vec3& hit,
                 const Vec3& normal) const {
        if (last.unconnected) {
            return 1;
        }
        const float other =
            choices_.probability(last.receiver, light) *
            (way.refractions > 0 ? way.connected * refracted_density(light, last.receiver, way, ray, hit, normal)
                                 : last.connected * density(light, last.receiver, ray, hit, normal));
        const float own = last.own_density();
        return own > 0 ? own / (own + other) : 0.0f;
    }

    /// Of the ray's direction, as seen from the receiver.
    float density(int light, const LightReceiver& from, const Ray& ray, const Vec3& hit, const Vec3& normal) const {
        return light_density(scene_.lights()[static_cast<std::size_t>(light)], from.position, ray.direction, hit,
                             normal, ray.time);
    }

    /// Of the first direction of a refracted way that ends with the ray: 0 where connections do not find it.
    float refracted_density(int light, const LightReceiver& from, const WayOut& way, const Ray& ray, const Vec3& hit,
                            const Vec3& normal) const {
        const Light& source = scene_.lights()[static_cast<std::size_t>(light)];
        const bool is_far = is_at_infinity(source);
        const Ray straight{from.position, is_far ? ray.direction : normalize(hit - from.position), ray.time};
        if (!is_seen_through_boundaries(source) || (!is_far && !emits_towards(source, normal, -straight.direction))) {
            return 0;
        }
        const float distance = is_far ? infinity : length(hit - from.position);
        const auto found = find_specular_chain(scene_, straight, distance, way.medium);
        constexpr float same = 1e-3f;
        return found && found->refractions == way.refractions && length(found->direction - way.direction) < same
                   ? found->density_ratio * density(light, from, straight, hit, normal)
                   : 0.0f;
    }

    const Scene& scene_;
    const LightSelection& choices_;
};

}  // namespace wend
