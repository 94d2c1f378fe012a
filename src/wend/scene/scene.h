// The scene that integrators see: immutable once built.
#pragma once

#include <wend/core/motion.h>
#include <wend/core/random.h>
#include <wend/core/vector.h>
#include <wend/medium/medium.h>
#include <wend/scene/camera.h>
#include <wend/scene/light.h>
#include <wend/scene/light_groups.h>
#include <wend/scene/light_sampler.h>
#include <wend/scene/material.h>
#include <wend/scene/media_at.h>
#include <wend/scene/object_names.h>
#include <wend/scene/shape.h>
#include <wend/scene/surface_detail.h>
#include <wend/scene/texture.h>
#include <wend/scene/traced_ray.h>

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

namespace wend {

/// What a surface is to rays of the camera that nothing has scattered.
enum class CameraView {
    shown,
    hidden,   ///< it is not there
    held_out  ///< it hides what is behind it, and there is a hole in the picture
};

/// A shape with what it is made of.
struct Surface {
    SharedShape shape;
    int material = 0;
    /// Media on the two sides; the same on both where the surface bounds no medium, and then the walk keeps the medium
    /// it is in.
    MediumId interior = vacuum;
    MediumId exterior = vacuum;
    /// The geometric normal points against the shape's own orientation. A mesh with normals follows those instead.
    bool flip_normal = false;
    /// Area light of the first primitive, those of the others following; -1: none. What shines is placed once at most,
    /// by the motion that its lights have.
    int first_light = -1;
    TextureId alpha = -1;  ///< probability of being there at all; -1: certain
    CameraView view = CameraView::shown;

    bool bounds_medium() const { return interior != exterior; }
};

/// Shapes that are placed several times, or that move together.
struct ObjectDefinition {
    std::vector<int> surfaces;

    friend bool operator==(const ObjectDefinition&, const ObjectDefinition&) = default;
};
struct Instance {
    int object = 0;
    Motion world_from_object;

    friend bool operator==(const Instance&, const Instance&) = default;
};

/// A light at infinity that rays which nothing has scattered see as another one.
struct Backdrop {
    int light = 0;
    Light seen;
};

/// What a scene consists of. Indices refer to the vectors here.
struct SceneDescription {
    Camera camera;
    MediumId camera_medium = vacuum;
    Textures textures;
    std::vector<Material> materials;
    std::vector<SurfaceDetail> details;  ///< by material, as far as there are any
    std::vector<Medium> media;
    std::vector<Surface> surfaces;
    std::vector<int> world_surfaces;  ///< those that are not part of an object definition
    std::vector<ObjectDefinition> objects;
    std::vector<Instance> instances;
    std::vector<Light> lights;
    std::vector<Backdrop> backdrops;  ///< those in `lights` that have one
    LightGroups light_groups;
    ObjectNames names;
    bool light_tree = true;  ///< choose lights by the tree, not by power alone
};

/// Where a ray meets a surface, as far as is known once it has been found.
struct RayHit {
    float distance;  ///< from where the ray has come to
    float t;         ///< from where it is traced from
    float u, v;
    SurfaceElement element;
};

/// Where a ray meets a surface.
struct Hit {
    float distance = 0;  ///< from where the ray has come to
    float t = 0;         ///< from where it is traced from
    float time = 0;      ///< of the ray
    Vec3 position;
    Vec3 normal;            ///< geometric, unit length, towards the exterior
    Frame shading;          ///< z: interpolated normal on the geometric normal's side; x along dp/du
    Vec2 uv{0, 0};          ///< surface parameters; not computed for interfaces
    Vec2 of_corners{0, 0};  ///< TexturePoint::of_corners
    const Surface* surface = nullptr;
    SurfaceElement element;
    float facing = 1;              ///< TexturePoint::facing
    bool is_behind = false;        ///< the ray came from where the normal does not point to
    bool against_winding = false;  ///< the normal is not that of the surface's winding, or of its equation
    float clearance = 0;           ///< by how much rounding may have moved the position
    float thickness = 0;           ///< of a curve: what leaves it starts so far outside of it; 0: no curve
    int light = -1;                ///< area light, if any
};

/// Where textures are evaluated for a hit.
inline TexturePoint texture_point(const Hit& hit) {
    return {hit.uv, hit.position, hit.normal, hit.is_behind, hit.element.primitive, hit.of_corners, hit.facing};
}

/// Embree's structures over the scene's surfaces.
class RayCaster;

class Scene {
public:
    /// Builds the acceleration structures, or shares those of another scene where they are the same: of the same
    /// shapes, seen alike and placed alike. Throws InputError if the scene holds nothing that can be rendered (no
    /// finite vertex ...).
    explicit Scene(SceneDescription description, const Scene* other = nullptr);
    ~Scene();
    Scene(const Scene&) = delete;
    Scene& operator=(const Scene&) = delete;

    /// The nearest surface ahead, interfaces included, within `distance`. Partly transparent surfaces are passed with
    /// their probability, decided by a hash of the ray, so that the answer is a function of the arguments.
    std::optional<RayHit> find(const TracedRay& ray, float distance = infinity) const;
    /// The place, normals and parameters, of what find() found on that ray.
    Hit complete(const RayHit& found, const Ray& ray) const;
    /// Both at once.
    std::optional<Hit> intersect(const TracedRay& ray, float distance = infinity) const {
        const auto found = find(ray, distance);
        return found ? std::optional(complete(*found, ray)) : std::nullopt;
    }
    /// By how much the shading normal changes when the hit moves by a small `displacement` along the surface, to first
    /// order.
    Vec3 normal_change(const Hit& hit, const Vec3& displacement) const;
    /// Whether anything opaque (no interface) lies within `distance`, but for the `target` of the ray.
    bool is_occluded(const TracedRay& ray, float distance, const SurfaceElement& target = {}) const;
    /// The nearest interface or partly transparent surface ahead within `distance`; opaque ones are not seen, nor is
    /// the `target` of the ray.
    std::optional<Hit> intersect_interface(const TracedRay& ray, float distance,
                                           const SurfaceElement& target = {}) const;
    /// Whether a surface found by intersect_interface() is there for this ray: as find() has it, what is not is neither
    /// met nor a boundary of its media.
    bool is_there(const Hit& hit, const Ray& ray) const;
    /// Whether intersect_interface() can return anything.
    bool has_interfaces() const { return has_interfaces_; }

    /// Whether the surface is the same for every ray that comes near: neither a mixture, partly there, nor bumpy.
    bool is_plain(const Hit& hit) const;
    /// What the surface is made of there: no mixture.
    const Material& material(const Hit& hit) const {
        return d_.materials[static_cast<std::size_t>(material_part(hit).index)];
    }
    bool is_interface(const Hit& hit) const { return std::holds_alternative<InterfaceMaterial>(material(hit)); }
    /// `count`, if given, becomes what it is multiplied with: where materials are sums.
    Bsdf bsdf(const Hit& hit, float* count = nullptr) const {
        const MaterialPart part = material_part(hit);
        if (count) {
            *count = part.count;
        }
        return make_bsdf(d_.materials[static_cast<std::size_t>(part.index)], d_.textures, texture_point(hit));
    }
    /// What the albedo is multiplied with in the medium inside, for a walk that enters it here; none where the boundary
    /// does not say.
    std::optional<Rgb> relative_albedo(const Hit& hit) const;
    /// Where a walk that was in `current` is on the side of the surface that `w` points to.
    MediumState medium_beyond(const Hit& hit, const Vec3& w, MediumState current) const {
        if (hit.surface->bounds_medium()) {
            regions_.cross(current, *hit.surface, hit.element, dot(w, hit.normal) < 0);
        }
        return current;
    }

    const Medium& medium(MediumId id) const { return d_.media[static_cast<std::size_t>(id)]; }
    const std::vector<Medium>& media() const { return d_.media; }
    /// Whether what a walk meets in this medium, or in vacuum, counts towards its largest depth.
    bool counts_vertices_in(MediumId id) const {
        const auto* inside = id != vacuum ? std::get_if<HomogeneousMedium>(&medium(id)) : nullptr;
        return !inside || inside->counts_vertices;
    }
    /// Which of the description's surfaces was hit.
    std::size_t surface_index(const Hit& hit) const {
        return static_cast<std::size_t>(hit.surface - d_.surfaces.data());
    }
    /// What the scene was built from.
    const SceneDescription& description() const { return d_; }
    /// Whether the acceleration structures are those of the other scene, and so all shapes.
    bool shares_geometry_with(const Scene& other) const;
    const Camera& camera() const { return d_.camera; }
    /// Whether anything depends on the time of rays.
    bool is_moving() const { return is_moving_; }
    /// Where the camera is at time 0.
    const MediumState& camera_medium() const { return camera_medium_; }
    /// Where the walk that begins with a ray of the camera begins.
    MediumState medium_around(const Ray& camera_ray) const;
    /// What an area light is, if that is flat; otherwise nothing that a ray meets.
    const SurfaceElement& flat_element(int light) const { return flat_lights_[static_cast<std::size_t>(light)]; }
    /// Those of the description, and then the media that glow.
    const std::vector<Light>& lights() const { return lights_; }
    /// The probability that a lamp's surface is there at a point of it; 1 for one that no ray meets, which shines with
    /// all that it has.
    float presence(int light, const TexturePoint& p) const;
    /// The light that a medium is, as an index of lights(); -1: none.
    int medium_light(MediumId id) const { return medium_lights_[static_cast<std::size_t>(id)]; }
    const std::vector<int>& infinite_lights() const { return infinite_lights_; }
    /// A light at infinity as it shines, or as rays see it that nothing has scattered.
    const Light& light_at_infinity(int light, bool is_scattered) const {
        for (const Backdrop& backdrop : d_.backdrops) {
            if (backdrop.light == light && !is_scattered) {
                return backdrop.seen;
            }
        }
        return lights_[static_cast<std::size_t>(light)];
    }
    /// Whether there are lights that only connections find.
    bool has_point_like_lights() const { return has_point_like_lights_; }
    const LightSampler& light_sampler() const { return *light_sampler_; }
    /// Bounds of all surfaces.
    const Box3& bounds() const { return bounds_; }
    /// Half of their diagonal.
    float radius() const { return 0.5f * length(bounds_.size()); }

private:
    void add_emitting_media();
    /// For each surface, the last instance that it is part of; -1: it is not placed.
    std::vector<int> instances_of_surfaces() const;
    /// For each region of a medium that a ray starts in, where it leaves that.
    std::vector<Hit> ways_out(const Ray& ray) const;
    MaterialPart material_part(const Hit& hit) const {
        return has_mixtures_ ? material_at(d_.materials, hit.surface->material, d_.textures, texture_point(hit))
                             : MaterialPart{hit.surface->material};
    }

    SceneDescription d_;
    std::unique_ptr<RayCaster> caster_;
    MediumRegions regions_;
    MediumState camera_medium_;
    std::vector<Hit> ways_out_of_camera_;  ///< at time 0
    bool is_moving_ = false;
    std::unique_ptr<LightSampler> light_sampler_;
    std::vector<Light> lights_;
    std::vector<SurfaceElement> flat_lights_;  ///< by light
    std::vector<TextureId> light_alpha_;       ///< by light, of lamps that are there with a probability; -1: none
    std::vector<int> medium_lights_;           ///< by medium
    std::vector<int> infinite_lights_;
    bool has_point_like_lights_ = false;
    Box3 bounds_;
    bool has_interfaces_ = false;
    bool has_mixtures_ = false;
    bool has_details_ = false;
};

}  // namespace wend
