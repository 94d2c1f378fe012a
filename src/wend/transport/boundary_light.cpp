#include <wend/transport/boundary_light.h>

#include <wend/light/scattering.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <optional>

namespace wend {
namespace {

/// From a point of a boundary, next to it on the side of w: of the point no more is known than where it is.
Ray next_to(const BoundaryPoint& point, const Vec3& w, float diameter) {
    constexpr float rounding = 2e-6f;
    const Vec3& p = point.position;
    const float by = rounding * (diameter + std::abs(p.x) + std::abs(p.y) + std::abs(p.z));
    return {p + point.normal * (dot(w, point.normal) < 0 ? -by : by), w, time_of_boundary_points};
}

/// The length of a way through the object, at most `farthest`.
float chord(const Scene& scene, MediumId medium, TracedRay ray, float farthest) {
    float sum = 0;
    // Past what does not end the medium, such as interfaces within it.
    for (int crossed = 0; crossed < 8 && sum < farthest; ++crossed) {
        const std::optional<Hit> hit = scene.intersect(ray, farthest);
        sum += hit ? hit->distance : farthest;
        if (!hit || !scene.is_interface(*hit) ||
            (hit->surface->bounds_medium() &&
             scene.medium_beyond(*hit, ray.direction, MediumState(medium)).id != medium)) {
            break;
        }
        ray.pass(*hit);
    }
    return std::min(sum, farthest);
}

/// Light of one of the scene's lights, just inside of the boundary.
struct Refracted {
    float fluence = 0;
    Vec3 towards{0, 0, 0};  ///< directions out to it, weighted with the fluence
};

/// Sums up samples of lights as they arrive at a point of a boundary.
class LightAtPoint {
public:
    LightAtPoint(const Scene& scene, const BoundaryPoint& point, float diameter, const BoundarySurface& boundary)
        : scene_(scene),
          point_(point),
          diameter_(diameter),
          frame_(Frame::from_z(point.normal)),
          boundary_(boundary.bsdf()) {}

    void add_sample(Pcg32& random) {
        const auto seen = see_light({point_.position, point_.normal}, random,
                                    [&](const Vec3& w) { return TracedRay(next_to(point_, w, diameter_)); });
        const float cosine = seen ? dot(seen->light.direction, point_.normal) : 0.0f;
        if (!(cosine > 0)) {
            return;
        }
        const LightSample& light = seen->light;
        const float brought = mean_value(light.radiance) * cosine / seen->density;
        if (!std::isfinite(brought)) {
            return;
        }
        irradiance_ += brought;
        // Walks cannot find what only connections reach, unless they can be connected at the boundary.
        if (light.point_like && boundary_.is_specular()) {
            return;
        }
        for (int k = 0; k < refractions; ++k) {
            const auto s = boundary_.sample(frame_.to_local(light.direction), random.uniform(), random.uniform2());
            if (!s || s->direction.z > 0) {
                continue;
            }
            // Of radiance a square of the index is lost to the BSDF, and regained by the walk that looks out.
            const float transmitted = sqr(boundary_.ior) * mean_value(s->value) / s->density;
            const float fluence = brought * transmitted / (refractions * std::max(least_cosine, -s->direction.z));
            Refracted& sum = by_light_[seen->index];
            sum.fluence += fluence;
            sum.towards -= frame_.to_world(s->direction) * fluence;
        }
    }

    /// Looks outwards for light that is reflected once. It is not known what comes through media and boundaries, or
    /// from mirrors.
    void look_around(Pcg32& random) {
        const Vec3 w = frame_.to_world(to_cosine_hemisphere(random.uniform2()));
        const std::optional<Hit> hit = scene_.intersect(next_to(point_, w, diameter_));
        const MediumState outside = scene_.camera_medium();
        const bool is_clear = (hit ? scene_.medium_beyond(*hit, -w, outside) : outside).id == vacuum;
        if (is_clear && !hit) {
            return;
        }
        std::optional<SurfaceScattering> f;
        if (is_clear && !scene_.is_interface(*hit)) {
            f.emplace(scene_, *hit, w);
        }
        if (!f || f->is_specular() || f->reflects_or_refracts()) {
            ++unknown_;
            return;
        }
        const auto from_hit = [&](const Vec3& towards) { return TracedRay::leave_anew(*hit, towards); };
        if (const auto seen = see_light({hit->position, hit->normal}, random, from_hit)) {
            const float radiance =
                mean_value(f->evaluate(seen->light.direction) * seen->light.radiance) / seen->density;
            reflected_ += std::isfinite(radiance) ? std::numbers::pi_v<float> * radiance : 0.0f;
        }
    }

    float irradiance(int samples) const { return irradiance_ / static_cast<float>(samples); }
    float reflected(int looks) const { return reflected_ / static_cast<float>(looks); }
    float unknown(int looks) const { return static_cast<float>(unknown_) / static_cast<float>(looks); }

    /// The strongest lamps; lights that are close to each other, such as triangles of a mesh, are one.
    void write_lamps(int samples, LitPoint& lit) const {
        std::vector<Refracted> lights;
        for (const auto& [index, light] : by_light_) {
            lights.push_back(light);
        }
        std::sort(lights.begin(), lights.end(),
                  [](const Refracted& a, const Refracted& b) { return a.fluence > b.fluence; });
        std::vector<Refracted> groups;
        for (const Refracted& light : lights) {
            const auto close = std::find_if(groups.begin(), groups.end(), [&](const Refracted& group) {
                return dot(normalize(group.towards), normalize(light.towards)) > together;
            });
            if (close == groups.end()) {
                groups.push_back(light);
            } else {
                close->fluence += light.fluence;
                close->towards += light.towards;
            }
        }
        std::vector<BoundaryEmitter> lamps;
        for (const Refracted& group : groups) {
            const float size = length(group.towards);
            const float kappa = vmf_kappa(size / group.fluence);
            if (kappa > least_kappa) {
                const Vmf seen = convolve({group.towards / size, kappa}, flatness);
                lamps.push_back({seen, std::max(0.05f, dot(seen.mean, point_.normal)),
                                 certainty() * group.fluence / static_cast<float>(samples), vmf_peak(seen.kappa)});
            }
        }
        const auto count = static_cast<std::ptrdiff_t>(std::min(lamps.size(), lit.lamps.size()));
        std::partial_sort(lamps.begin(), lamps.begin() + count, lamps.end(),
                          [](const BoundaryEmitter& a, const BoundaryEmitter& b) { return a.fluence > b.fluence; });
        std::copy_n(lamps.begin(), count, lit.lamps.begin());
        lit.emitter_count = static_cast<int>(count);
    }

private:
    struct SeenLight {
        int index;
        LightSample light;
        float density;  ///< of the choice and the sample
    };

    /// One of the lights, if nothing stands before it on the ray that `start` makes of its direction.
    template <class Start>
    std::optional<SeenLight> see_light(const LightReceiver& receiver, Pcg32& random, const Start& start) const {
        const float u = random.uniform();
        const Vec2 u2 = random.uniform2();
        const ChosenLight chosen =
            std::visit([&](const auto& s) { return s.sample(receiver, u); }, scene_.light_sampler());
        if (chosen.index < 0) {
            return std::nullopt;
        }
        const auto light = sample_light(scene_.lights()[static_cast<std::size_t>(chosen.index)], receiver.position, u2,
                                        random, time_of_boundary_points);
        if (!light || scene_.is_occluded(start(light->direction), light->distance * (1 - 1e-3f))) {
            return std::nullopt;
        }
        return SeenLight{chosen.index, *light, light->density * chosen.probability};
    }

    // What is so wide that the diffuse light does as well.
    static constexpr float least_kappa = 4;
    // Cosine between lights that are taken for one.
    static constexpr float together = 0.97f;
    // A flat piece of boundary stands for a curved one: the concentration of a lobe that blurs as much.
    static constexpr float flatness = 1100;
    // Directions into the object for each sample of a light.
    static constexpr int refractions = 4;
    // Of those that facets turn along the boundary.
    static constexpr float least_cosine = 0.1f;

    /// What goes on scattering varies much more than what flies out to a lamp, and walks are drawn by second moments:
    /// of 0.07, 0.2, 1 and 4 the second was the best on three scenes. Through a rough boundary connections do most of
    /// it.
    float certainty() const { return boundary_.is_specular() ? 0.2f : 0.1f; }

    const Scene& scene_;
    const BoundaryPoint& point_;
    float diameter_;
    Frame frame_;
    DielectricBsdf boundary_;
    float irradiance_ = 0;
    float reflected_ = 0;
    int unknown_ = 0;
    std::map<int, Refracted> by_light_;
};

}  // namespace

std::vector<LitPoint> lit_points(const Scene& scene, std::span<const BoundaryPoint> points,
                                 const BoundarySurface& boundary, int samples, Pcg32& random) {
    std::vector<LitPoint> result;
    const float diameter = length(bounds_of(points).size());
    const std::vector<float> curvatures = mean_curvatures(points);
    std::vector<float> unknown;  // by point, the share of ways outwards on which light may come that is not known
    constexpr int looks = 16;
    float total = 0;
    for (std::size_t i = 0; i < points.size(); ++i) {
        const BoundaryPoint& point = points[i];
        LightAtPoint light(scene, point, diameter, boundary);
        for (int k = 0; k < samples; ++k) {
            light.add_sample(random);
        }
        for (int k = 0; k < looks; ++k) {
            light.look_around(random);
        }
        result.push_back({point, curvatures[i], light.irradiance(samples) + light.reflected(looks)});
        light.write_lamps(samples, result.back());
        total += result.back().irradiance;
        unknown.push_back(light.unknown(looks));
    }
    // Beside what is known of the light. In the shadow of a shield even a little more would lead all walks astray.
    constexpr float mean_of_unknown = 0.02f, never_nothing = 1e-20f;
    const float mean = total > 0 ? total / static_cast<float>(result.size()) : 1 / never_nothing;
    for (std::size_t i = 0; i < result.size(); ++i) {
        result[i].irradiance += mean * (mean_of_unknown * unknown[i] + never_nothing);
    }
    return result;
}

float mean_chord(const Scene& scene, MediumId medium, std::span<const BoundaryPoint> points, Pcg32& random) {
    const float diameter = length(bounds_of(points).size());
    float sum = 0;
    for (const BoundaryPoint& point : points) {
        const Vec3 inward = Frame::from_z(-point.normal).to_world(to_cosine_hemisphere(random.uniform2()));
        sum += chord(scene, medium, next_to(point, inward, diameter), diameter);
    }
    return points.empty() ? 0.0f : sum / static_cast<float>(points.size());
}

}  // namespace wend
