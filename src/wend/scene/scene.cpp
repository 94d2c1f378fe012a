#include <wend/scene/scene.h>

#include <wend/core/error.h>
#include <wend/scene/ray_caster.h>

#include <algorithm>
#include <bit>

namespace wend {
namespace {

/// Primitives of a surface, each of which is a light if the surface shines.
std::size_t lights_on(const Surface& surface) {
    const auto* mesh = std::get_if<TriangleMesh>(surface.shape.get());
    return mesh ? mesh->triangle_count() : 1;
}

std::uint32_t flat_primitives(const Shape& shape) {
    if (const auto* mesh = std::get_if<TriangleMesh>(&shape)) {
        return static_cast<std::uint32_t>(mesh->triangle_count());
    }
    const auto* quadric = std::get_if<Quadric>(&shape);
    return quadric && std::holds_alternative<Disk>(quadric->shape) ? 1 : 0;
}

}  // namespace

Scene::Scene(SceneDescription description, const Scene* other) : d_(std::move(description)) {
    caster_ = std::make_unique<RayCaster>(d_, other ? other->caster_.get() : nullptr);
    regions_ = MediumRegions(d_);
    is_moving_ = d_.camera.is_moving() ||
                 std::ranges::any_of(d_.instances, [](const Instance& i) { return i.world_from_object.is_moving(); }) ||
                 std::ranges::any_of(d_.surfaces, [](const Surface& s) { return wend::is_moving(*s.shape); });
    camera_medium_ = MediumState(d_.camera_medium);
    if (!regions_.is_empty()) {
        ways_out_of_camera_ = ways_out(d_.camera.middle());
        for (const Hit& hit : ways_out_of_camera_) {
            regions_.cross(camera_medium_, *hit.surface, hit.element, true);
        }
        // The scene has the last word on what is around the camera.
        camera_medium_.id = d_.camera_medium;
    }
    lights_ = d_.lights;
    add_emitting_media();
    for (std::size_t i = 0; i < lights_.size(); ++i) {
        if (is_at_infinity(lights_[i])) {
            infinite_lights_.push_back(static_cast<int>(i));
        }
        has_point_like_lights_ = has_point_like_lights_ || is_point_like(lights_[i]);
    }
    flat_lights_.resize(lights_.size());
    light_alpha_.assign(lights_.size(), -1);
    const std::vector<int> instance_of = instances_of_surfaces();
    for (std::size_t i = 0; i < d_.surfaces.size(); ++i) {
        const Surface& surface = d_.surfaces[i];
        const std::uint32_t flat = surface.first_light >= 0 ? flat_primitives(*surface.shape) : 0;
        const auto first = static_cast<std::size_t>(std::max(surface.first_light, 0));
        flat_lights_.resize(std::max(flat_lights_.size(), first + flat));
        for (std::uint32_t k = 0; k < flat; ++k) {
            flat_lights_[first + k] = {static_cast<std::uint32_t>(i), k, instance_of[i]};
        }
        for (std::size_t k = first; surface.first_light >= 0 && k < lights_.size() && k < first + lights_on(surface);
             ++k) {
            const Presence presence = presence_of(lights_[k]);
            light_alpha_[k] = presence == Presence::partly || presence == Presence::once ? surface.alpha : -1;
        }
        const Material& material = d_.materials[static_cast<std::size_t>(surface.material)];
        has_interfaces_ |= std::holds_alternative<InterfaceMaterial>(material) || surface.alpha >= 0;
    }
    has_mixtures_ = std::any_of(d_.materials.begin(), d_.materials.end(),
                                [](const Material& m) { return std::holds_alternative<MixMaterial>(m); });
    has_details_ =
        std::any_of(d_.details.begin(), d_.details.end(), [](const SurfaceDetail& d) { return !d.is_none(); });
    bounds_ = caster_->bounds();
    if (!(bounds_.min.x <= bounds_.max.x)) {
        bounds_ = Box3(Vec3(-1), Vec3(1));  // nothing but lights and media
    }
    light_sampler_ = std::make_unique<LightSampler>(d_.light_tree ? LightSampler(TreeLightSampler(lights_, radius()))
                                                                  : LightSampler(PowerLightSampler(lights_, radius())));
}

Scene::~Scene() = default;

bool Scene::shares_geometry_with(const Scene& other) const {
    return caster_->shares_structure_with(*other.caster_);
}

std::vector<Hit> Scene::ways_out(const Ray& start) const {
    // A region whose boundary a ray crosses outwards first is one that the ray started in.
    constexpr int most_crossings = 10000;
    TracedRay ray(start);
    std::vector<Hit> ways;
    std::vector<int> met;
    for (int i = 0; i < most_crossings; ++i) {
        const auto found = caster_->intersect(ray, infinity, Visible::everything);
        if (!found) {
            break;
        }
        const Hit hit = caster_->complete(*found, ray);
        const int region = hit.surface->bounds_medium() ? regions_.region(hit.element) : MediumRegions::none;
        if (region != MediumRegions::none && std::find(met.begin(), met.end(), region) == met.end()) {
            met.push_back(region);
            if (dot(hit.normal, ray.direction) > 0) {
                ways.push_back(hit);
            }
        }
        ray.pass(hit);
    }
    return ways;
}

MediumState Scene::medium_around(const Ray& camera_ray) const {
    if (!is_moving_ || regions_.is_empty()) {
        return camera_medium_;
    }
    // What differs from time 0, where the scene says what is around the camera.
    const std::vector<Hit> ways = ways_out(camera_ray);
    const auto has_region_of = [this](const std::vector<Hit>& hits, const Hit& hit) {
        return std::any_of(hits.begin(), hits.end(),
                           [&](const Hit& h) { return regions_.region(h.element) == regions_.region(hit.element); });
    };
    MediumState state = camera_medium_;
    for (const Hit& hit : ways) {
        if (!has_region_of(ways_out_of_camera_, hit)) {
            regions_.cross(state, *hit.surface, hit.element, true);
        }
    }
    for (const Hit& hit : ways_out_of_camera_) {
        if (!has_region_of(ways, hit)) {
            regions_.cross(state, *hit.surface, hit.element, false);
        }
    }
    return state;
}

std::vector<int> Scene::instances_of_surfaces() const {
    std::vector<int> instances(d_.surfaces.size(), -1);
    for (std::size_t i = 0; i < d_.instances.size(); ++i) {
        for (const int surface : d_.objects[static_cast<std::size_t>(d_.instances[i].object)].surfaces) {
            instances[static_cast<std::size_t>(surface)] = static_cast<int>(i);
        }
    }
    return instances;
}

void Scene::add_emitting_media() {
    std::vector<bool> is_used(d_.media.size(), false);
    const auto use = [&](MediumId id) {
        if (id != vacuum) {
            is_used[static_cast<std::size_t>(id)] = true;
        }
    };
    use(d_.camera_medium);
    for (const Surface& surface : d_.surfaces) {
        use(surface.interior);
        use(surface.exterior);
    }
    medium_lights_.assign(d_.media.size(), -1);
    for (std::size_t id = 0; id < d_.media.size(); ++id) {
        const auto* grid = std::get_if<GridMedium>(&d_.media[id]);
        if (grid && grid->glow() && is_used[id]) {
            medium_lights_[id] = static_cast<int>(lights_.size());
            lights_.push_back(MediumLight{static_cast<int>(id), grid});
        }
    }
}

std::optional<RayHit> Scene::find(const TracedRay& ray, float distance) const {
    TracedRay rest = ray;
    for (;;) {
        const float passed = rest.passed() - ray.passed();
        auto found = caster_->intersect(rest, distance - passed, Visible::everything);
        if (!found) {
            return found;
        }
        if (d_.surfaces[found->element.surface].alpha >= 0) {
            const Hit hit = caster_->complete(*found, rest);
            if (!is_there(hit, rest)) {
                rest.pass(hit);
                continue;
            }
        }
        found->distance += passed;
        return found;
    }
}

Hit Scene::complete(const RayHit& found, const Ray& ray) const {
    Hit hit = caster_->complete(found, ray);
    if (has_details_) {
        const auto material = static_cast<std::size_t>(material_part(hit).index);
        if (material < d_.details.size() && !d_.details[material].is_none()) {
            hit.shading = detailed_frame(d_.details[material], hit.shading, hit.normal, texture_point(hit),
                                         caster_->derivatives(hit), d_.textures);
        }
    }
    return hit;
}

bool Scene::is_plain(const Hit& hit) const {
    const auto material = static_cast<std::size_t>(hit.surface->material);
    return hit.surface->alpha < 0 && !std::holds_alternative<MixMaterial>(d_.materials[material]) &&
           (material >= d_.details.size() || d_.details[material].is_none());
}

float Scene::presence(int light, const TexturePoint& p) const {
    const TextureId alpha = light_alpha_[static_cast<std::size_t>(light)];
    return alpha < 0 ? 1.0f : std::clamp(d_.textures.evaluate_grey(alpha, p), 0.0f, 1.0f);
}

std::optional<Rgb> Scene::relative_albedo(const Hit& hit) const {
    TextureId albedo = -1;
    if (const auto* boundary = std::get_if<DielectricMaterial>(&material(hit))) {
        albedo = boundary->relative_albedo;
    } else if (const auto* principled = std::get_if<PrincipledMaterial>(&material(hit))) {
        albedo = principled->relative_albedo;
    }
    return albedo < 0 ? std::nullopt : std::optional(d_.textures.evaluate(albedo, texture_point(hit)));
}

Vec3 Scene::normal_change(const Hit& hit, const Vec3& displacement) const {
    return caster_->normal_change(hit, displacement);
}

bool Scene::is_occluded(const TracedRay& ray, float distance, const SurfaceElement& target) const {
    return caster_->is_occluded(ray, distance, target);
}

bool Scene::is_there(const Hit& hit, const Ray& ray) const {
    if (hit.surface->alpha < 0) {
        return true;
    }
    const float alpha = d_.textures.evaluate_grey(hit.surface->alpha, texture_point(hit));
    const auto bits = [](float x) { return std::bit_cast<std::uint32_t>(x); };
    const std::uint64_t h = hash_of(bits(ray.origin.x), bits(ray.origin.y), bits(ray.origin.z), bits(ray.direction.x),
                                    bits(ray.direction.y), bits(ray.direction.z), bits(hit.distance));
    return to_unit_float(static_cast<std::uint32_t>(h)) < alpha;
}

std::optional<Hit> Scene::intersect_interface(const TracedRay& ray, float distance,
                                              const SurfaceElement& target) const {
    const auto raw = caster_->intersect(ray, distance, Visible::interfaces, target);
    if (!raw) {
        return std::nullopt;
    }
    return caster_->complete(*raw, ray);
}

}  // namespace wend
