#include <wend/transport/subsurface_guides.h>

#include <wend/core/parallel.h>
#include <wend/decision/channels.h>
#include <wend/medium/fresnel.h>
#include <wend/planar/half_space.h>
#include <wend/subsurface/half_space_mode.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

namespace wend {
namespace {

constexpr float defensive_fraction = 0.25f;

// Points of a boundary, and rays for the light that each gets.
constexpr int points_of_boundary = 1024;
constexpr int rays_to_lights = 64;

// Mean free paths in a mean chord from which on a medium is dense: below, most walks end after a few collisions, and
// there is little to guide.
constexpr float least_depth = 4;
// Nor where nearly all that collides is absorbed; or where the phase function is too peaked for a direction to matter.
constexpr float least_scattering = 0.2f;
constexpr float most_peaked = 0.96f;

bool may_be_dense(const HomogeneousMedium& medium) {
    const Rgb extinction = medium.extinction();
    return is_black(medium.emission) && max_value(medium.scattering) > least_scattering * max_value(extinction) &&
           std::abs(medium.phase.mean_cosine()) < most_peaked;
}

/// That of the first surface around a medium.
BoundarySurface surface_of_boundary(const SceneDescription& scene, MediumId medium) {
    const auto found = std::find_if(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
        return (surface.interior == medium) != (surface.exterior == medium);
    });
    if (found == scene.surfaces.end()) {
        return {};
    }
    const auto* dielectric =
        std::get_if<DielectricMaterial>(&scene.materials[static_cast<std::size_t>(found->material)]);
    if (!dielectric) {
        return {};
    }
    const float roughness = std::clamp(scene.textures.evaluate_grey(dielectric->roughness.u, {}), 0.0f, 1.0f);
    return {std::clamp(dielectric->ior, 1.0f, 3.0f), dielectric->roughness.remap ? safe_sqrt(roughness) : roughness};
}

/// The rates of decay of diffuse light, per scene unit.
Rgb decay_of(const InteriorGuide& guide) {
    Rgb decay;
    for (int c = 0; c < 3; ++c) {
        decay[c] = guide.mode(std::min(c, guide.channels() - 1), guide.level(1)).k() * guide.medium.extinction()[c];
    }
    return decay;
}

/// Of an irradiance on the boundary, the radiance that a walk may expect inside that turns away from it.
Rgb returned_by(const HomogeneousMedium& medium, const BoundarySurface& boundary) {
    const double g = medium.phase.mean_cosine();
    const double inner = boundary.ior > 1 ? static_cast<double>(fresnel_diffuse_reflectance(1 / boundary.ior)) : 0.0;
    Rgb result;
    for (int c = 0; c < 3; ++c) {
        const float extinction = medium.extinction()[c];
        if (extinction == 0) {
            result[c] = 0;
            continue;
        }
        const double albedo = static_cast<double>(medium.scattering[c] / extinction);
        const double reflected = diffuse_reflectance(std::clamp(albedo * (1 - g) / (1 - albedo * g), 0.05, 1.0));
        result[c] = static_cast<float>(reflected / (1 - inner * reflected) / std::numbers::pi);
    }
    return result;
}

/// Of its boundary; none where it is not dense.
std::vector<BoundaryPoint> points_of_dense_medium(const Scene& scene, MediumId id, Pcg32& random) {
    const auto* medium = std::get_if<HomogeneousMedium>(&scene.media()[static_cast<std::size_t>(id)]);
    if (!medium || !may_be_dense(*medium)) {
        return {};
    }
    auto points = boundary_points(scene.description(), id, points_of_boundary, static_cast<std::size_t>(id));
    const float depth = mean_chord(scene, id, points, random) * mean_value(medium->extinction());
    return depth >= least_depth ? points : std::vector<BoundaryPoint>();
}

}  // namespace

bool SubsurfaceGuides::has_dense_medium(const Scene& scene) {
    for (std::size_t id = 0; id < scene.media().size(); ++id) {
        Pcg32 random(id);
        if (!points_of_dense_medium(scene, static_cast<MediumId>(id), random).empty()) {
            return true;
        }
    }
    return false;
}

SubsurfaceGuides::SubsurfaceGuides(const Scene& scene, const SubsurfacePreset& preset) : strategy_(preset.strategy) {
    if (preset.is_classical()) {
        return;
    }
    media_.resize(scene.media().size());
    for (std::size_t id = 0; id < media_.size(); ++id) {
        Pcg32 random(id);
        const auto points = points_of_dense_medium(scene, static_cast<MediumId>(id), random);
        if (!points.empty()) {
            const auto& medium = std::get<HomogeneousMedium>(scene.media()[id]);
            media_[id] = explore(scene, static_cast<MediumId>(id), medium, points, random);
        }
    }
}

auto SubsurfaceGuides::explore(const Scene& scene, MediumId id, const HomogeneousMedium& medium,
                               const std::vector<BoundaryPoint>& points, Pcg32& random) const
    -> std::unique_ptr<Dense> {
    InteriorGuide guide = interior_guide(medium, half_space_modes(medium), defensive_fraction);
    const Box3 box = bounds_of(points);
    const BoundarySurface boundary = surface_of_boundary(scene.description(), id);
    const Rgb decay = decay_of(guide);
    std::optional<BoundaryField> field;
    if (strategy_ != InteriorStrategy::entry) {
        field.emplace(box, lit_points(scene, points, boundary, rays_to_lights, random), min_value(decay));
    }
    guide.heads_for_emitters = strategy_ == InteriorStrategy::learned && field->sees_emitters();
    guide.connects_at_boundary = !boundary.bsdf().is_specular();
    TechniqueMixes plans(box, guide.defensive_fraction);
    return std::make_unique<Dense>(
        Dense{std::move(guide), std::move(plans), std::move(field), decay, returned_by(medium, boundary)});
}

const TechniqueMix* SubsurfaceGuides::plan(MediumId medium, const Vec3& entry) const {
    if (medium == vacuum || media_.empty() || !media_[static_cast<std::size_t>(medium)]) {
        return nullptr;
    }
    const TechniqueMixes& plans = media_[static_cast<std::size_t>(medium)]->plans;
    return &plans.plan(plans.cell_at(entry));
}

void SubsurfaceGuides::enter(MediumId medium, const Hit& hit, const Vec3& direction, const Rgb& channels,
                             InteriorWalk& walk) const {
    const Dense& dense = *media_[static_cast<std::size_t>(medium)];
    if (walk.guide() != &dense.guide) {
        walk.enter(dense.guide, channels, plan(medium, hit.position)->defensive_fraction);
        walk.aim(dot(hit.normal, direction) < 0 ? hit.normal : -hit.normal);
    }
    aim(medium, hit.position, walk);
    walk.head(direction);
}

void SubsurfaceGuides::aim(MediumId medium, const Vec3& position, InteriorWalk& walk) const {
    const Dense& dense = *media_[static_cast<std::size_t>(medium)];
    if (!dense.field || !walk.is_guided()) {
        return;
    }
    const BoundaryField::View around = dense.field->at(position);
    const InteriorAim aim = strategy_ == InteriorStrategy::closest ? around.closest() : around.incident();
    walk.aim(aim.normal, aim.steepness);
    if (walk.heads_for_emitters()) {
        walk.aim(around.lamps(dense.returned, dense.decay));
    }
}

void SubsurfaceGuides::count(const InteriorWalkRecord& interior_walk, SecondMoments& moments) const {
    const TechniqueMixes& plans = media_[static_cast<std::size_t>(interior_walk.medium)]->plans;
    moments.add(plans.cell_at(interior_walk.entry), plans.relative(interior_walk));
}

void SubsurfaceGuides::learn(const SecondMoments& moments, NextWalks next) {
    for (std::size_t id = 0; id < media_.size(); ++id) {
        if (media_[id]) {
            media_[id]->plans.learn(moments.of(static_cast<int>(id)), next);
        }
    }
}

}  // namespace wend
