#include <wend/core/error.h>
#include <wend/scene/ray_caster.h>
#include <wend/scene/scene.h>

#include <bit>

namespace wend {
namespace {

/// Moves a coordinate by a distance that scales with its own precision (waechter2019).
float nudge(float p, float n) {
    constexpr float near_origin = 1.0f / 32;
    constexpr float float_scale = 1.0f / 65536;
    constexpr float int_scale = 256;
    if (std::abs(p) < near_origin) {
        return p + float_scale * n;
    }
    const int offset = static_cast<int>(int_scale * n);
    return std::bit_cast<float>(std::bit_cast<int>(p) + (p < 0 ? -offset : offset));
}

/// Whether a partly transparent surface is there for this ray.
bool is_there(const Hit& hit, const Ray& ray, const Textures& textures) {
    if (hit.surface->alpha < 0) {
        return true;
    }
    const float alpha = textures.evaluate_grey(hit.surface->alpha, {hit.uv, hit.position});
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    const std::uint64_t h = hash_of(bits(ray.origin.x), bits(ray.origin.y), bits(ray.origin.z), bits(ray.direction.x),
                                    bits(ray.direction.y), bits(ray.direction.z), bits(hit.distance));
    return to_unit_float(static_cast<std::uint32_t>(h)) < alpha;
}

}  // namespace

Ray spawn_ray(const Vec3& position, const Vec3& normal, const Vec3& w) {
    const Vec3 n = dot(normal, w) >= 0 ? normal : -normal;
    return {{nudge(position.x, n.x), nudge(position.y, n.y), nudge(position.z, n.z)}, w};
}

Scene::Scene(SceneDescription description) : d_(std::move(description)) {
    caster_ = std::make_unique<RayCaster>(d_);
    for (std::size_t i = 0; i < d_.lights.size(); ++i) {
        if (is_at_infinity(d_.lights[i])) {
            infinite_lights_.push_back(static_cast<int>(i));
        }
        has_point_like_lights_ = has_point_like_lights_ || std::holds_alternative<PointLight>(d_.lights[i]) ||
                                 std::holds_alternative<DistantLight>(d_.lights[i]);
    }
    for (const Surface& surface : d_.surfaces) {
        const Material& material = d_.materials[static_cast<std::size_t>(surface.material)];
        has_interfaces_ |= std::holds_alternative<InterfaceMaterial>(material) || surface.alpha >= 0;
    }
    bounds_ = caster_->bounds();
    if (!(bounds_.min.x <= bounds_.max.x)) {
        bounds_ = Box3(Vec3(-1), Vec3(1));  // nothing but lights and media
    }
    const float radius = 0.5f * length(bounds_.size());
    light_sampler_ = std::make_unique<LightSampler>(d_.light_tree ? LightSampler(TreeLightSampler(d_.lights, radius))
                                                                  : LightSampler(PowerLightSampler(d_.lights, radius)));
}

Scene::~Scene() = default;

std::optional<Hit> Scene::intersect(const Ray& ray, float distance) const {
    Ray rest = ray;
    float passed = 0;
    for (;;) {
        const auto raw = caster_->intersect(rest, distance - passed, RayCaster::everything);
        if (!raw) {
            return std::nullopt;
        }
        Hit hit = caster_->complete(*raw, rest);
        if (is_there(hit, rest, d_.textures)) {
            hit.distance += passed;
            return hit;
        }
        passed += hit.distance;
        rest = spawn_ray(hit.position, hit.normal, ray.direction);
    }
}

bool Scene::is_occluded(const Ray& ray, float distance) const {
    return caster_->is_occluded(ray, distance);
}

bool Scene::blocks(const Hit& hit, const Ray& ray) const {
    return !is_interface(hit) && is_there(hit, ray, d_.textures);
}

std::optional<Hit> Scene::intersect_interface(const Ray& ray, float distance) const {
    const auto raw = caster_->intersect(ray, distance, RayCaster::interfaces);
    if (!raw) {
        return std::nullopt;
    }
    return caster_->complete(*raw, ray);
}

}  // namespace wend
