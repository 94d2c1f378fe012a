// The walk of integrator/path_tracer.h, to be included where a set of decisions is instantiated.
#pragma once

#include <wend/decision/channels.h>
#include <wend/integrator/path_tracer.h>
#include <wend/integrator/scattering.h>
#include <wend/medium/transmittance.h>

#include <algorithm>

namespace wend {

template <class Decisions>
class PathTracer<Decisions>::Walk {
public:
    Walk(const PathTracer& tracer, Sampler& sampler, guide::PathLog* log)
        : tracer_(tracer), scene_(tracer.scene_), d_(tracer.decisions_), sampler_(sampler), log_(log) {}

    WalkResult run(const Ray& start) {
        if (log_) {
            log_->start();
        }
        ray_ = start;
        medium_ = scene_.camera_medium();
        while (step()) {
        }
        result_.sample.radiance = radiance_;
        return result_;
    }

private:
    /// One flight to the next collision, surface or interface; false where the walk ends.
    bool step() {
        ++result_.segments;
        const std::optional<Hit> hit = scene_.intersect(ray_);
        const float length = hit ? hit->distance : farthest;
        if (medium_ != vacuum) {
            const Medium& medium = scene_.medium(medium_);
            const Flight flight =
                d_.distance.sample(medium, ray_, length, throughput_, sampler_.uniform(), sampler_.random());
            gather(flight.emitted);
            weigh(flight.weight);
            if (is_black(throughput_)) {
                return false;
            }
            if (flight.scatters) {
                travelled_ += flight.distance;
                return scatter_in(medium, flight.distance);
            }
            pass_probability_ *= d_.distance.pass_probability(medium, ray_, length);
        }
        if (!hit) {
            add_environment();
            return false;
        }
        travelled_ += hit->distance;
        if (hit->light >= 0) {
            add_emission(*hit);
        }
        if (scene_.is_interface(*hit)) {
            medium_ = scene_.medium_beyond(*hit, ray_.direction, medium_);
            ray_ = spawn_ray(hit->position, hit->normal, ray_.direction);
            // A walk that meets hundreds of interfaces in a row is caught between coincident surfaces.
            return ++interfaces_ < max_interfaces;
        }
        return scatter_at(*hit);
    }

    bool scatter_in(const Medium& medium, float distance) {
        meet();
        if (depth_ == 0) {
            remember_first(albedo(medium), {0, 0, 0});
        }
        if (depth_++ >= tracer_.max_depth_) {
            return false;
        }
        const Vec3 position = ray_.at(distance);
        const VolumeScattering f(phase_function(medium), ray_.direction);
        return scatter(f, position, {0, 0, 0}, true);
    }

    bool scatter_at(const Hit& hit) {
        meet();
        const SurfaceScattering f(scene_.bsdf(hit), hit.shading, ray_.direction);
        if (depth_ == 0) {
            remember_first(f.albedo(), hit.shading.n);
        }
        if (depth_++ >= tracer_.max_depth_) {
            return false;
        }
        hit_ = &hit;
        return scatter(f, hit.position, hit.normal, false);
    }

    /// Connects a vertex to a light, draws a direction, and decides on survival. `normal` is zero in a volume.
    template <class F>
    bool scatter(const F& f, const Vec3& position, const Vec3& normal, bool in_volume) {
        const auto directions = d_.direction.at(position, in_volume, f, boost_);
        if (!f.is_specular()) {
            gather(connect(f, directions, position, normal, in_volume));
        }
        const float u = sampler_.uniform();
        const auto s = directions.sample(u, sampler_.uniform2());
        if (!s) {
            return false;
        }
        scatter_into(*s, position, in_volume);
        boost_ *= s->boost;
        index_scale_ *= sqr(f.index_ratio(s->direction));
        specular_ = s->specular;
        density_ = s->density;
        receiver_ = {position, normal};
        pass_probability_ = Rgb(1.0f);
        channels_ = channel_probabilities(throughput_);
        const float expected = d_.survival.expected_continuations({throughput_, boost_, index_scale_, depth_});
        if (expected < 1) {
            if (!(sampler_.uniform() < expected)) {
                return false;
            }
            weigh(Rgb(1 / expected));
        }
        if (in_volume) {
            ray_ = {position, s->direction};
        } else {
            medium_ = scene_.medium_beyond(*hit_, s->direction, medium_);
            ray_ = spawn_ray(position, normal, s->direction);
        }
        travelled_ = 0;
        return true;
    }

    /// Next-event estimation: the contribution of one connection to one light, per unit of throughput.
    template <class F, class Directions>
    Rgb connect(const F& f, const Directions& directions, const Vec3& position, const Vec3& normal, bool in_volume) {
        const float u = sampler_.uniform();
        const Vec2 u2 = sampler_.uniform2();
        const LightReceiver receiver{position, normal};
        const ChosenLight chosen =
            std::visit([&](const auto& s) { return s.sample(receiver, u); }, scene_.light_sampler());
        if (chosen.index < 0) {
            return Rgb(0.0f);
        }
        const auto light = sample_light(scene_.lights()[static_cast<std::size_t>(chosen.index)], position, u2);
        if (!light) {
            return Rgb(0.0f);
        }
        const Rgb value = f.evaluate(light->direction);
        if (is_black(value)) {
            return Rgb(0.0f);
        }
        Ray shadow = in_volume ? Ray{position, light->direction} : spawn_ray(position, normal, light->direction);
        float distance = light->distance;
        if (!in_volume && distance < infinity) {
            // Moving the origin off the surface must not move the far end through the light.
            const Vec3 rest = position + light->direction * distance - shadow.origin;
            distance = length(rest);
            shadow.direction = rest / distance;
        }
        const MediumId medium = in_volume ? medium_ : scene_.medium_beyond(*hit_, light->direction, medium_);
        const Passage passage = pass(shadow, distance, medium);
        if (is_black(passage.transmittance)) {
            return Rgb(0.0f);
        }
        const float light_density = chosen.probability * light->density;
        float weight = 1;
        if (!light->point_like) {
            const Rgb channels = channel_probabilities(throughput_ * value);
            const float other = directions.density(light->direction) * dot(channels, passage.probability);
            weight = light_density / (light_density + other);
        }
        return value * light->radiance * passage.transmittance * (weight / light_density);
    }

    /// What a straight line to a light meets: an estimate of the transmittance, 0 where it is blocked, and the
    /// probability, by channel, that a walk would have flown through.
    struct Passage {
        Rgb transmittance{1.0f};
        Rgb probability{1.0f};
    };
    Passage pass(Ray ray, float distance, MediumId medium) {
        Passage passage;
        float rest = distance == infinity ? farthest : distance * (1 - 1e-4f);
        if (scene_.is_occluded(ray, rest)) {
            return {Rgb(0.0f), Rgb(0.0f)};
        }
        for (int crossed = 0; crossed < max_interfaces; ++crossed) {
            const std::optional<Hit> hit =
                scene_.has_interfaces() ? scene_.intersect_interface(ray, rest) : std::nullopt;
            if (hit && scene_.blocks(*hit, ray)) {
                return {Rgb(0.0f), Rgb(0.0f)};
            }
            const float length = hit ? hit->distance : rest;
            if (medium != vacuum) {
                passage.transmittance *= estimate_transmittance(scene_.medium(medium), ray, length, sampler_.random());
                passage.probability *= d_.distance.pass_probability(scene_.medium(medium), ray, length);
                if (is_black(passage.transmittance)) {
                    return passage;
                }
            }
            if (!hit) {
                return passage;
            }
            rest -= length;
            medium = scene_.medium_beyond(*hit, ray.direction, medium);
            ray = spawn_ray(hit->position, hit->normal, ray.direction);
        }
        return {Rgb(0.0f), Rgb(0.0f)};
    }

    /// Light that the walk ran into, weighted against the connection that could have found it.
    float emission_weight(int light, const Vec3& hit, const Vec3& normal) const {
        if (depth_ == 0 || specular_) {
            return 1;
        }
        const float chosen =
            std::visit([&](const auto& s) { return s.probability(receiver_, light); }, scene_.light_sampler());
        const float other = chosen * light_density(scene_.lights()[static_cast<std::size_t>(light)], receiver_.position,
                                                   ray_.direction, hit, normal);
        const float own = density_ * dot(channels_, pass_probability_);
        return own > 0 ? own / (own + other) : 0.0f;
    }

    void add_emission(const Hit& hit) {
        const Rgb emitted =
            emitted_radiance(scene_.lights()[static_cast<std::size_t>(hit.light)], hit.normal, -ray_.direction);
        if (!is_black(emitted)) {
            gather(emitted * emission_weight(hit.light, hit.position, hit.normal));
        }
    }

    void add_environment() {
        for (const int light : scene_.infinite_lights()) {
            const Rgb arriving = environment_radiance(scene_.lights()[static_cast<std::size_t>(light)], ray_.direction);
            if (!is_black(arriving)) {
                gather(arriving * emission_weight(light, {}, {}));
            }
        }
    }

    void remember_first(const Rgb& surface_albedo, const Vec3& normal) {
        result_.sample.albedo = surface_albedo;
        result_.sample.normal = normal;
        result_.sample.depth = travelled_;
    }

    // What the walk multiplies and adds, told to the log as well.
    void weigh(const Rgb& weight) {
        throughput_ *= weight;
        if (log_) {
            log_->weigh(weight);
        }
    }
    void gather(const Rgb& radiance) {
        radiance_ += throughput_ * radiance;
        if (log_) {
            log_->gather(radiance);
        }
    }
    void meet() {
        if (log_) {
            log_->meet(travelled_);
        }
    }
    void scatter_into(const DirectionSample& s, const Vec3& position, bool in_volume) {
        throughput_ *= s.weight();
        if (log_) {
            log_->scatter(position, s.direction, s.specular ? 0 : s.density, s.weight(), in_volume);
            // In a channel without throughput the walk draws nothing, and what it finds there says nothing.
            log_->weigh(
                {throughput_.r > 0 ? 1.0f : 0.0f, throughput_.g > 0 ? 1.0f : 0.0f, throughput_.b > 0 ? 1.0f : 0.0f});
        }
    }

    static constexpr float farthest = 1e30f;
    static constexpr int max_interfaces = 1000;

    const PathTracer& tracer_;
    const Scene& scene_;
    const Decisions& d_;
    Sampler& sampler_;
    guide::PathLog* log_;

    Ray ray_{};
    MediumId medium_ = vacuum;
    Rgb throughput_{1.0f};
    Rgb radiance_;
    float boost_ = 1;
    float index_scale_ = 1;
    int depth_ = 0;
    int interfaces_ = 0;
    float travelled_ = 0;       ///< since the last vertex
    const Hit* hit_ = nullptr;  ///< of the surface vertex at hand

    // The last vertex, as multiple importance sampling wants it.
    LightReceiver receiver_{};
    bool specular_ = false;
    float density_ = 0;
    Rgb channels_;
    Rgb pass_probability_;

    WalkResult result_;
};

template <class Decisions>
WalkResult PathTracer<Decisions>::trace(const Ray& ray, Sampler& sampler, guide::PathLog* log) const {
    return Walk(*this, sampler, log).run(ray);
}

}  // namespace wend
