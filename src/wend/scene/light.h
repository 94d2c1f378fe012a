// Light sources. A light is sampled from a point that it may illuminate.
#pragma once

#include <wend/core/colour.h>
#include <wend/core/image.h>
#include <wend/core/motion.h>
#include <wend/core/random.h>
#include <wend/core/transform.h>
#include <wend/medium/medium.h>
#include <wend/sampling/discrete.h>
#include <wend/scene/directional_light.h>
#include <wend/scene/emission_profile.h>
#include <wend/scene/light_picture.h>
#include <wend/scene/portal_light.h>
#include <wend/scene/shape.h>

#include <array>
#include <memory>
#include <optional>
#include <variant>

namespace wend {

/// A sampled connection to a light.
struct LightSample {
    Vec3 direction;           ///< towards the light, unit length
    float distance = 0;       ///< infinity for lights at infinity
    Rgb radiance;             ///< arriving without any loss; for point-like lights irradiance on a facing surface
    float density = 0;        ///< per steradian; 1 for lights at a point or of one direction
    bool point_like = false;  ///< cannot be hit by a ray
    int medium = -1;          ///< of a medium that glows, its index: the light is where that medium is
    Vec2 uv{0, 0};            ///< surface parameters, on a lamp
    Vec3 normal{0, 0, 0};     ///< geometric, of unit length, on a lamp
};

/// An isotropic point source; intensity in power per steradian.
struct PointLight {
    Vec3 position;
    Rgb intensity;
};

/// Parallel light, `direction` towards the source; `radiance` is the irradiance on a facing surface.
struct DistantLight {
    Vec3 direction;
    Rgb radiance;
};

/// The same radiance from a disc of the sky around a direction, as of the sun.
struct SkyDiskLight {
    Vec3 direction;  ///< towards the middle, unit length
    Rgb radiance;
    float one_minus_cosine;  ///< of half the angle across, above 0
};

/// The same radiance from everywhere.
struct UniformInfiniteLight {
    Rgb radiance;
};

/// Radiance from infinity by direction: a square picture in the equal-area octahedral mapping (clarberg2008), as
/// pbrt-v4 has it.
class ImageInfiniteLight {
public:
    ImageInfiniteLight(Image image, float scale, const Transform& world_from_light);

    Rgb radiance(const Vec3& direction) const;
    float density(const Vec3& direction) const;
    LightSample sample(const Vec2& u) const;
    Rgb mean_radiance() const { return mean_; }

private:
    Rgb texel(int x, int y) const;

    Image image_;
    float scale_;
    AffineMap world_from_light_;
    AffineMap light_from_world_;
    PiecewiseConstant2D distribution_;
    Rgb mean_;
};

/// Whether rays meet a lamp.
enum class Presence {
    solid,
    partly,  ///< with the probability that its surface has; as in pbrt, rays that nothing stands in for find it twice
    once,    ///< with that probability, once for all rays
    passed,  ///< always, and they go on behind it
    unseen   ///< never: it shines, and only connections find it
};

/// How a triangle that shines moves: its corners evenly to where they are at time 1, and then all of it as it is
/// placed.
struct TriangleMotion {
    std::array<Vec3, 3> end;
    std::shared_ptr<const Motion> placement;  ///< null: it stays where the corners are
    bool flip = false;                        ///< of make_triangle_light()
};

/// A triangle that emits from the side its normal points to, or from both.
struct TriangleLight {
    Vec3 p0, p1, p2;  ///< of one that moves, at time 0, before it is placed
    Vec3 normal;      ///< unit length, the emitting side
    float area = 0;
    Rgb radiance;
    bool two_sided = false;
    Presence presence = Presence::solid;
    /// Multiplies the radiance, by (u, 1 - v) of the surface's parameters; null: 1.
    std::shared_ptr<const LightPicture> picture = nullptr;
    /// Multiplies the radiance, by direction; null: 1.
    std::shared_ptr<const EmissionProfile> profile = nullptr;
    Vec2 uv0{0, 0}, uv1{1, 0}, uv2{1, 1};
    /// Null: it stands still. Of one that moves, `normal` and `area` are those at time 0.
    std::shared_ptr<const TriangleMotion> motion = nullptr;
};

/// An emitting sphere or disk, sampled uniformly by area in its own space, a sphere from outside only on the side that
/// can be seen.
struct QuadricLight {
    std::shared_ptr<const Quadric> quadric;
    float flip = 1;  ///< -1 where the normal is reversed
    Rgb radiance;
    bool two_sided = false;
    float object_area = 0;
    float determinant = 1;  ///< absolute volume factor of the quadric's map to the world
    Presence presence = Presence::solid;
    /// Multiplies the radiance, by (u, 1 - v) of the surface's parameters; null: 1.
    std::shared_ptr<const LightPicture> picture = nullptr;
    /// Multiplies the radiance, by direction; null: 1.
    std::shared_ptr<const EmissionProfile> profile = nullptr;
    /// Of the quadric in its world; null: it stands still.
    std::shared_ptr<const Motion> motion = nullptr;
};

/// A heterogeneous medium that glows. Connections lead to points in it, whose radiance is that of a line as long as
/// the unit of EmissionSampler, and whose density is per steradian and such a unit.
struct MediumLight {
    int medium;              ///< its index in the scene
    const GridMedium* grid;  ///< the same; its glow() is not null
};

/// Radiance from infinity through a window.
struct PortalInfiniteLight {
    std::shared_ptr<const PortalLight> portal;
};

using Light =
    std::variant<PointLight, DistantLight, UniformInfiniteLight, ImageInfiniteLight, TriangleLight, QuadricLight,
                 MediumLight, SpotLight, GoniometricLight, ProjectionLight, PortalInfiniteLight, SkyDiskLight>;

/// A connection from `p` to the light as it stands at a time (Ray::time); none where it cannot shine. `u` places it on
/// the light, `random` in its depth.
std::optional<LightSample> sample_light(const Light& light, const Vec3& p, const Vec2& u, Pcg32& random,
                                        float time = 0);

/// Density with which sample_light(light, p) yields `direction` (LightSample) at a time, whose ray meets an area light
/// at `hit` with unit normal `hit_normal` (both ignored for lights at infinity), or passes `hit` in a medium that
/// glows.
float light_density(const Light& light, const Vec3& p, const Vec3& direction, const Vec3& hit, const Vec3& hit_normal,
                    float time = 0);

/// Radiance that leaves an area light at a point with the given unit geometric normal and surface parameters towards w,
/// where the light's surface is there at all.
Rgb emitted_radiance(const Light& light, const Vec3& normal, const Vec2& uv, const Vec3& w);
/// Whether an area light emits on the side of the normal that w points to.
bool emits_towards(const Light& light, const Vec3& normal, const Vec3& w);

/// Radiance that arrives from infinity along -direction at a point; black for other lights.
Rgb environment_radiance(const Light& light, const Vec3& p, const Vec3& direction);

bool is_at_infinity(const Light& light);
/// Whether no ray can meet it, so that only connections find it.
bool is_point_like(const Light& light);
/// Solid, but for an area light whose surface is not.
Presence presence_of(const Light& light);

/// Emitted power, mean of the channels, as a scale for choosing among lights; `scene_radius` bounds what lights at
/// infinity reach. Of what moves, at time 0.
float light_power(const Light& light, float scene_radius);

/// Area light of a triangle; `flip` reverses its normal.
TriangleLight make_triangle_light(const Vec3& p0, const Vec3& p1, const Vec3& p2, bool flip, const Rgb& radiance,
                                  bool two_sided);

/// Area light of a quadric.
QuadricLight make_quadric_light(std::shared_ptr<const Quadric> quadric, const Transform& world_from_object, bool flip,
                                const Rgb& radiance, bool two_sided);

/// Unit square to unit sphere and back, preserving area (clarberg2008).
Vec3 equal_area_square_to_sphere(const Vec2& p);
Vec2 equal_area_sphere_to_square(const Vec3& d);

}  // namespace wend
