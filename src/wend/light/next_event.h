// What a straight line from a vertex to a light meets, for walks that connect their vertices to lights.
#pragma once

#include <wend/decision/distance.h>
#include <wend/light/light_selection.h>
#include <wend/light/specular_chain.h>
#include <wend/medium/transmittance.h>
#include <wend/scene/scene.h>
#include <wend/subsurface/interior_walk.h>

#include <algorithm>
#include <optional>

namespace wend {

/// A ray that meets as many interfaces in a row is caught between coincident surfaces.
inline constexpr int most_interfaces = 1000;

/// A direction towards a light that was chosen, with the probability of that choice.
struct ChosenSample {
    int index;
    LightSample light;
    float probability;

    /// Of the direction, for lights that a ray can hit.
    float density() const { return probability * light.density; }
};

/// `u` chooses the light, `u2` and `random` the point of it as it stands at a time (Ray::time); nothing where no light
/// reaches the receiver.
inline std::optional<ChosenSample> choose_light(const Scene& scene, const LightSelection& choices,
                                                const LightReceiver& receiver, float u, Vec2 u2, Pcg32& random,
                                                float time) {
    const ChosenLight chosen = choices.sample(receiver, u);
    if (chosen.index < 0) {
        return std::nullopt;
    }
    auto light =
        sample_light(scene.lights()[static_cast<std::size_t>(chosen.index)], receiver.position, u2, random, time);
    if (light && light->distance < infinity) {
        light->radiance *= scene.presence(
            chosen.index, {light->uv, receiver.position + light->direction * light->distance, light->normal});
    }
    return light ? std::optional(ChosenSample{chosen.index, *light, chosen.probability}) : std::nullopt;
}

struct ShadowRay {
    TracedRay ray;
    float length;
    MediumId medium;          ///< that glows at its end; vacuum for other lights
    SurfaceElement target{};  ///< what it ends on, if that is flat: it is not met on the way
};

/// A ray from a vertex at `position` in the light's direction, up to the light.
inline ShadowRay shadow_ray(const Scene& scene, TracedRay ray, const Vec3& position, const ChosenSample& chosen) {
    const LightSample& light = chosen.light;
    if (light.distance == infinity) {
        return {ray, light.distance, light.medium};
    }
    // Neither where the ray begins, beside the position, nor rounding must move its end through a lamp that is seen
    // edge on. It ends short of what lies in the lamp's place, and of a lamp that is not flat.
    const float part = light.medium == vacuum ? 1 - 1e-4f : 1.0f;
    const float distance = ray.aim_at(position + light.direction * light.distance);
    return {ray, distance * part, light.medium, scene.flat_element(chosen.index)};
}

/// An estimate of the transmittance, 0 where something blocks the light, and the probability, by channel, that a walk
/// would have flown through.
struct Passage {
    Rgb transmittance{1.0f};
    Rgb probability{1.0f};
};

/// From a place in `medium`, and in a guided interior walk in a dense one if `interior` is not null, which goes on and
/// ends where the medium does.
template <DistanceDecision Distance>
Passage pass(const Scene& scene, const Distance& distance, const ShadowRay& shadow, MediumState medium,
             InteriorWalk* interior, Pcg32& random) {
    constexpr Passage blocked{Rgb(0.0f), Rgb(0.0f)};
    Passage passage;
    TracedRay ray = shadow.ray;
    float rest = std::min(shadow.length, longest_segment);
    if (scene.is_occluded(ray, rest, shadow.target)) {
        return blocked;
    }
    for (int crossed = 0; crossed < most_interfaces; ++crossed) {
        const std::optional<Hit> hit =
            scene.has_interfaces() ? scene.intersect_interface(ray, rest, shadow.target) : std::nullopt;
        const bool is_there = hit && scene.is_there(*hit, ray);
        if (is_there && !scene.is_interface(*hit)) {
            return blocked;
        }
        const float length = hit ? hit->distance : rest;
        if (medium.id != vacuum) {
            const Medium& passed = scene.medium(medium.id);
            passage.transmittance *= estimate_transmittance(passed, ray, length, random);
            passage.probability *=
                interior ? Rgb(interior->pass(length)) : distance.pass_probability(passed, ray, length);
            if (is_black(passage.transmittance)) {
                return passage;
            }
        }
        if (!hit) {
            // A grid may reach farther than the medium that it tells of.
            return shadow.medium == vacuum || shadow.medium == medium.id ? passage : blocked;
        }
        rest -= length;
        if (is_there) {
            const MediumId before = medium.id;
            medium = scene.medium_beyond(*hit, ray.direction, medium);
            if (medium.id != before) {
                interior = nullptr;
            }
        }
        ray.pass(*hit);
    }
    return blocked;
}

/// The same along a way that boundaries refract. The interior walk ends with its first leg's medium, or where one
/// within it turns the walk: from there on that does not go where it chose to.
template <DistanceDecision Distance>
Passage pass(const Scene& scene, const Distance& distance, const SpecularChain& way, InteriorWalk* interior,
             Pcg32& random) {
    Passage passage{way.transmitted, Rgb(1.0f)};
    const MediumId first = way.legs().front().medium;
    for (const SpecularChain::Leg& leg : way.legs()) {
        if (leg.medium != first || leg.refractions > 0) {
            interior = nullptr;
        }
        if (leg.medium != vacuum) {
            const Medium& medium = scene.medium(leg.medium);
            const float length = std::min(leg.length, longest_segment);
            passage.transmittance *= estimate_transmittance(medium, leg.ray, length, random);
            passage.probability *=
                interior ? Rgb(interior->pass(length)) : distance.pass_probability(medium, leg.ray, length);
        }
    }
    return passage;
}

}  // namespace wend
