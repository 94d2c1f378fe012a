#include <wend/light/caustic_photons.h>

#include <wend/core/parallel.h>
#include <wend/decision/distance.h>
#include <wend/light/next_event.h>
#include <wend/light/scattering.h>
#include <wend/scene/surface_sampler.h>

#include <algorithm>
#include <array>
#include <utility>
#include <variant>
#include <vector>

namespace wend {
namespace {

/// Vessels have a few boundaries; after more the light is faint.
constexpr int most_boundaries = 12;
/// Glass reflects little, but over wide places that nothing else is known of.
constexpr float odds_of_reflection = 10;

struct Photon {
    CausticLobe
        lobe;  ///< in a medium its light is the flux over the scattering coefficient, as collisions tell of fluence
    bool in_volume;
};

bool is_smooth(const SceneDescription& scene, const Surface& surface) {
    const Material& material = scene.materials[static_cast<std::size_t>(surface.material)];
    // A thin sheet turns no light, and what a mixture is depends on the point.
    if (std::holds_alternative<InterfaceMaterial>(material) || std::holds_alternative<MixMaterial>(material) ||
        std::holds_alternative<ThinDielectricMaterial>(material)) {
        return false;
    }
    const TexturePoint anywhere{{0, 0}, {0, 0, 0}};
    return std::visit([](const auto& bsdf) { return bsdf.is_specular(); },
                      make_bsdf(material, scene.textures, anywhere));
}

/// Follows light from a source.
class PhotonFlight {
public:
    PhotonFlight(const Scene& scene, const TracedRay& start, const MediumState& medium, const Rgb& flux, Pcg32& random)
        : scene_(scene), ray_(start), medium_(medium), flux_(flux), random_(random) {}

    /// To the first surface that is none of a medium alone: whether it is one at this distance.
    bool reach(float distance) {
        for (int met = 0; met < most_interfaces; ++met) {
            hit_ = scene_.intersect(ray_);
            if (!hit_) {
                return false;
            }
            if (medium_.id != vacuum) {
                flux_ *= estimate_transmittance(scene_.medium(medium_.id), ray_, hit_->distance, random_);
            }
            travelled_ += hit_->distance;
            if (!scene_.is_interface(*hit_)) {
                return std::abs(travelled_ - distance) < 1e-3f * distance;
            }
            medium_ = scene_.medium_beyond(*hit_, ray_.direction, medium_);
            ray_.pass(*hit_);
        }
        return false;
    }

    /// From there to where it arrives.
    std::optional<Photon> arrive() {
        int boundaries = 0;
        for (int met = 0; hit_ && met < most_interfaces && boundaries < most_boundaries; ++met) {
            if (scene_.is_interface(*hit_)) {
                medium_ = scene_.medium_beyond(*hit_, ray_.direction, medium_);
                ray_.pass(*hit_);
            } else {
                SurfaceScattering f(scene_, *hit_, ray_.direction);
                if (f.reflects_or_refracts()) {
                    f.prefer_reflection(odds_of_reflection);
                }
                if (!f.is_specular()) {
                    return boundaries > 0 && hit_->light < 0 ? photon_at(hit_->position, flux_, false) : std::nullopt;
                }
                const auto s = f.sample(random_.uniform(), random_.uniform2());
                if (!s) {
                    return std::nullopt;
                }
                // Flux, unlike radiance, does not change with the index.
                flux_ *= s->weight() * sqr(f.index_ratio(s->direction));
                medium_ = scene_.medium_beyond(*hit_, s->direction, medium_);
                ray_ = ray_.leave(*hit_, s->direction);
                ++boundaries;
            }
            hit_ = scene_.intersect(ray_);
            if (fly()) {
                const Vec3& position = ray_.origin;
                const Medium& medium = scene_.medium(medium_.id);
                const float scattering = mean_value(extinction_at(medium, position) * albedo(medium));
                return photon_at(position, flux_ * (1 / scattering), true);
            }
        }
        return std::nullopt;
    }

private:
    /// To the hit ahead, or to a collision before it: whether there is one, where the ray begins then.
    bool fly() {
        FlightStart start;
        start.ray = ray_;
        start.length = hit_ ? hit_->distance : longest_segment;
        start.throughput = flux_;
        if (medium_.id == vacuum) {
            travelled_ += start.length;
            return false;
        }
        const Flight flight = ClassicalDistance().sample(scene_.medium(medium_.id), start, random_.uniform(), random_);
        flux_ *= flight.weight;
        travelled_ += flight.distance;
        ray_.origin = flight.scatters ? ray_.at(flight.distance) : ray_.origin;
        return flight.scatters;
    }

    std::optional<Photon> photon_at(const Vec3& position, const Rgb& light, bool in_volume) const {
        return max_value(light) > 0 && is_finite(light)
                   ? std::optional(Photon{{position, -ray_.direction, travelled_, light}, in_volume})
                   : std::nullopt;
    }

    const Scene& scene_;
    TracedRay ray_;
    MediumState medium_;
    Rgb flux_;
    Pcg32& random_;
    std::optional<Hit> hit_;
    float travelled_ = 0;
};

/// Light of one lamp on its way to a point of a smooth surface, of which there are `density` per area, at a time.
std::optional<Photon> shoot(const Scene& scene, const LightSelection& lights, const SurfaceSampler::Point& target,
                            float density, float time, Pcg32& random) {
    const float u = random.uniform();
    const Vec2 u2 = random.uniform2();
    const auto chosen = choose_light(scene, lights, {target.position, {0, 0, 0}}, u, u2, random, time);
    if (!chosen || chosen->light.point_like || chosen->light.medium != vacuum) {
        return std::nullopt;
    }
    const LightSample& light = chosen->light;
    const float distance = light.distance < infinity ? light.distance * (1 - 1e-4f) : 2 * length(scene.bounds().size());
    const Rgb flux = light.radiance * (std::abs(dot(light.direction, target.normal)) / (density * chosen->density()));
    // Where the light is, as far as the target knows; interfaces on the way will tell.
    const MediumState medium = !target.surface->bounds_medium()          ? scene.camera_medium()
                               : dot(light.direction, target.normal) > 0 ? MediumState(target.surface->exterior)
                                                                         : MediumState(target.surface->interior);
    PhotonFlight flight(scene, Ray{target.position + light.direction * distance, -light.direction, time}, medium, flux,
                        random);
    return flight.reach(distance) ? flight.arrive() : std::nullopt;
}

}  // namespace

CausticPhotons::CausticPhotons(const Scene& scene, int count, std::uint64_t seed, int threads) {
    const SceneDescription& description = scene.description();
    const SurfaceSampler sampler(description, [&](const Surface& s) { return is_smooth(description, s); });
    if (sampler.is_empty() || scene.lights().empty()) {
        return;
    }
    constexpr int per_block = 1024;
    const int blocks = (count + per_block - 1) / per_block;
    const float density = static_cast<float>(blocks * per_block) / sampler.area();
    struct Arrived {
        std::vector<CausticLobe> surface, volume;
    };
    const LightSelection lights(scene);
    std::vector<Arrived> arrived(static_cast<std::size_t>(blocks));
    parallel_for(arrived.size(), threads, [&](std::size_t block) {
        Pcg32 random(hash_of(seed, block));
        for (int i = 0; i < per_block; ++i) {
            const float u = random.uniform();
            const Vec2 u2 = random.uniform2();
            const float time = scene.is_moving() ? scene.camera().shutter().time(random.uniform()) : 0.0f;
            if (const auto photon = shoot(scene, lights, sampler.sample(u, u2, time), density, time, random)) {
                (photon->in_volume ? arrived[block].volume : arrived[block].surface).push_back(photon->lobe);
            }
        }
    });
    Arrived all;
    for (const Arrived& some : arrived) {
        all.surface.insert(all.surface.end(), some.surface.begin(), some.surface.end());
        all.volume.insert(all.volume.end(), some.volume.begin(), some.volume.end());
    }
    on_surfaces_ = CausticMap(std::move(all.surface));
    in_media_ = CausticMap(std::move(all.volume));
}

}  // namespace wend
