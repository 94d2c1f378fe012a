#include <wend/render/walks.h>

#include <wend/transport/path_tracer.h>

#include <optional>

namespace wend {

template class PathTracer<ClassicalDecisions, Learners::Recorders>;
template class PathTracer<GuidedDecisions<guide::Field, ClassicalDistance, ClassicalRoulette>, Learners::Recorders>;
template class PathTracer<GuidedDecisions<guide::Field, ClassicalDistance, AdjointRouletteSplitting>,
                          Learners::Recorders>;
template class PathTracer<GuidedDecisions<guide::Field, GuidedDistance<guide::Field>, ClassicalRoulette>,
                          Learners::Recorders>;
template class PathTracer<GuidedDecisions<guide::Field, GuidedDistance<guide::Field>, AdjointRouletteSplitting>,
                          Learners::Recorders>;

Walks::Walks(const Scene& scene, Film& film, const RenderSettings& settings, const GuidingChoice& choice,
             const Learners& learners)
    : scene_(scene),
      film_(film),
      settings_(settings),
      choice_(choice),
      learners_(learners),
      beams_(beams_of(scene.lights(), scene.radius())),
      unknown_{guide::Field::empty(scene.bounds()), guide::Field::empty(scene.bounds())},
      towards_beams_(&unknown_.surface, &unknown_.volume, classical_flights, DistanceGuiding::scatter_and_distance,
                     beams_) {
}

bool Walks::walk(const PassPlan& plan, const Rest& rest, Tile& tile, Learners::Records& records) const {
    const Preset& preset = choice_.kinds()[tile.kinds_done].preset;
    const auto run_with = [&](const auto& decisions) {
        const Pass one(scene_, film_, settings_, decisions, choice_, tile.kinds_done, learners_, plan, rest);
        return one.run(tile, records);
    };
    if (!preset.is_classical()) {
        return walk_guided(preset, plan, run_with);
    }
    // Longer walks teach more, and where nothing is taught only their noise counts: in fog, where each has many
    // collisions ahead, they cost more than they bring (docs/experiments/survival.md).
    const bool teach = !settings_.preset.is_classical() && (plan.is_of_guided_render || !has_fog(scene_));
    const ClassicalRoulette survival = teach ? unguided_walks_end : ClassicalRoulette();
    if (settings_.preset.is_classical() || beams_.empty()) {
        return run_with(ClassicalDecisions{{}, {}, survival});
    }
    return run_with(GuidedDecisions{
        towards_beams_, GuidedDirection<guide::Field>(&unknown_.surface, &unknown_.volume, 1.0f), survival});
}

template <class Run>
bool Walks::walk_guided(const Preset& preset, const PassPlan& plan, const Run& run_with) const {
    const auto& learned = learners_.get<FieldLearner>();
    const guide::Fields& fields = learned.fields();
    const GuidedDistance distance(
        &fields.surface, &fields.volume, classical_flights,
        preset.distance ? DistanceGuiding::scatter_and_distance : DistanceGuiding::scatter_alone, beams_);
    const GuidedDirection direction(&fields.surface, &fields.volume,
                                    preset.direction ? std::nullopt : std::optional(1.0f),
                                    preset.direction ? &learned.surface_caustics() : nullptr,
                                    preset.direction ? &learned.volume_caustics() : nullptr);
    const auto run_guided = [&](const auto& survival) {
        if (preset.guides_distance() || !beams_.empty()) {
            return run_with(GuidedDecisions{preset.guides_distance() ? distance : towards_beams_, direction, survival});
        }
        return run_with(GuidedDecisions{ClassicalDistance(), direction, survival});
    };
    if (plan.estimates.empty()) {
        return run_guided(guided_walks_end);
    }
    return run_guided(AdjointRouletteSplitting(preset.roulette, preset.splitting, plan.sample_variance));
}

}  // namespace wend
