#include <wend/core/error.h>
#include <wend/core/parallel.h>
#include <wend/decision/channels.h>
#include <wend/integrator/subsurface.h>
#include <wend/theory/lit_layers.h>
#include <wend/theory/slab_modes.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace wend {
namespace {

struct Entry {
    std::string_view name;
    std::vector<SlabStrategy> strategies;
};

const std::vector<Entry>& entries() {
    using enum SlabStrategy;
    static const std::vector<Entry> table = {{"classical", {}},      {"dwivedi", {entry}},
                                             {"closest", {closest}}, {"incident", {incident}},
                                             {"planar", {planar}},   {"auto", {entry, closest, incident}}};
    return table;
}

// Of the contract, not built.
constexpr std::array planned = {"learned"};

constexpr float classical_share = 0.25f;

// Points of a boundary, and rays for the light that each gets.
constexpr int points_of_boundary = 1024;
constexpr int rays_to_lights = 16;

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

bool looks_around(SlabStrategy strategy) {
    return strategy != SlabStrategy::entry;
}

/// Relative index of refraction of the first surface around a medium. That it may be rough is left out: a guide may be
/// wrong.
double ior_of_boundary(const SceneDescription& scene, MediumId medium) {
    const auto found = std::find_if(scene.surfaces.begin(), scene.surfaces.end(), [&](const Surface& surface) {
        return (surface.interior == medium) != (surface.exterior == medium);
    });
    if (found == scene.surfaces.end()) {
        return 1;
    }
    const auto* dielectric =
        std::get_if<DielectricMaterial>(&scene.materials[static_cast<std::size_t>(found->material)]);
    return dielectric ? std::clamp(static_cast<double>(dielectric->ior), 1.0, 3.0) : 1.0;
}

/// The rate of decay, per scene unit, of the channel that reaches deepest.
float least_decay(const SlabGuide& guide) {
    float least = infinity;
    for (int c = 0; c < guide.channels(); ++c) {
        least = std::min(least, guide.mode(c, guide.level(1)).k() * guide.medium.extinction()[c]);
    }
    return least;
}

}  // namespace

std::string subsurface_names() {
    std::string names;
    for (const Entry& e : entries()) {
        names += (names.empty() ? "" : ", ") + std::string(e.name);
    }
    return names;
}

SubsurfacePreset parse_subsurface(std::string_view text) {
    for (const Entry& e : entries()) {
        if (e.name == text) {
            return {e.strategies};
        }
    }
    const bool is_planned = std::find(planned.begin(), planned.end(), text) != planned.end();
    throw InputError((is_planned ? "the subsurface sampling '" + std::string(text) + "' is not built yet"
                                 : "unknown subsurface sampling '" + std::string(text) + "'") +
                     ": expected one of " + subsurface_names());
}

std::string to_string(const SubsurfacePreset& preset) {
    const auto found = std::find_if(entries().begin(), entries().end(),
                                    [&](const Entry& e) { return e.strategies == preset.strategies; });
    return std::string(found->name);
}

SubsurfaceGuides::SubsurfaceGuides(const Scene& scene, const SubsurfacePreset& preset, int threads)
    : strategies_(preset.strategies) {
    if (preset.is_classical()) {
        return;
    }
    media_.resize(scene.media().size());
    for (std::size_t id = 0; id < media_.size(); ++id) {
        const auto* medium = std::get_if<HomogeneousMedium>(&scene.media()[id]);
        if (!medium || !may_be_dense(*medium)) {
            continue;
        }
        Pcg32 random(id);
        const auto points = boundary_points(scene.description(), static_cast<MediumId>(id), points_of_boundary, id);
        const float depth =
            mean_chord(scene, static_cast<MediumId>(id), points, random) * max_value(medium->extinction());
        if (points.empty() || !(depth >= least_depth)) {
            continue;
        }
        SlabGuide guide =
            slab_guide(*medium, slab_modes(*medium), static_cast<int>(strategies_.size()), classical_share);
        const Box3 box = bounds_of(points);
        std::optional<BoundaryField> field;
        if (std::any_of(strategies_.begin(), strategies_.end(), looks_around)) {
            field.emplace(box, lit_points(scene, static_cast<MediumId>(id), points, rays_to_lights, random),
                          least_decay(guide), threads);
        }
        const auto layered = std::find(strategies_.begin(), strategies_.end(), SlabStrategy::planar);
        // A channel that nothing hits has no layers.
        if (layered != strategies_.end() && min_value(medium->extinction()) > 0) {
            guide.layered = static_cast<int>(layered - strategies_.begin());
            guide.layers.resize(static_cast<std::size_t>(guide.channels()));
            const double ior = ior_of_boundary(scene.description(), static_cast<MediumId>(id));
            parallel_for(guide.layers.size(), threads, [&](std::size_t c) {
                const double extinction = medium->extinction()[static_cast<int>(c)];
                const double albedo = static_cast<double>(medium->scattering[static_cast<int>(c)]) / extinction;
                const double g = medium->phase.mean_cosine();
                guide.layers[c] = LayerGuide(extinction, g, lit_layers(albedo, g, ior));
            });
        }
        StayPlans plans(box, guide.share);
        media_[id] = std::make_unique<Dense>(Dense{std::move(guide), std::move(plans), std::move(field)});
    }
}

void SubsurfaceGuides::enter(MediumId medium, const Hit& hit, const Vec3& direction, const Rgb& channels,
                             SlabWalk& walk) const {
    const Dense* dense = medium == vacuum || media_.empty() ? nullptr : media_[static_cast<std::size_t>(medium)].get();
    if (!dense) {
        walk.leave();
        return;
    }
    if (walk.guide() != &dense->guide) {
        walk.enter(dense->guide, channels, dense->plans.plan(dense->plans.cell_at(hit.position)).shares);
        for (int slot = 0; slot < walk.slots(); ++slot) {
            walk.aim(slot, dot(hit.normal, direction) < 0 ? hit.normal : -hit.normal);
        }
    }
    aim(medium, hit.position, walk);
    walk.head(direction);
}

void SubsurfaceGuides::aim(MediumId medium, const Vec3& position, SlabWalk& walk) const {
    const std::optional<BoundaryField>& field = media_[static_cast<std::size_t>(medium)]->field;
    for (int slot = 0; slot < walk.slots(); ++slot) {
        const SlabStrategy strategy = strategies_[static_cast<std::size_t>(walk.strategy(slot))];
        if (walk.is_layered(slot)) {
            walk.aim(field->layer(position));
        } else if (looks_around(strategy)) {
            const SlabAim aim =
                strategy == SlabStrategy::incident ? field->incident(position) : field->closest(position);
            walk.aim(slot, aim.normal, aim.steepness);
        }
    }
}

float SubsurfaceGuides::preference(MediumId medium, const Vec3& entry) const {
    const StayPlans& plans = media_[static_cast<std::size_t>(medium)]->plans;
    return plans.plan(plans.cell_at(entry)).preference;
}

void SubsurfaceGuides::count(const Stay& stay, StayMoments& moments) const {
    moments.add(media_[static_cast<std::size_t>(stay.medium)]->plans.cell_at(stay.entry), stay);
}

void SubsurfaceGuides::learn(const StayMoments& moments) {
    for (std::size_t id = 0; id < media_.size(); ++id) {
        if (media_[id]) {
            media_[id]->plans.learn(moments.of(static_cast<int>(id)));
        }
    }
}

}  // namespace wend
