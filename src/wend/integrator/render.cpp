#include <wend/core/parallel.h>
#include <wend/film/pixel_estimate.h>
#include <wend/integrator/pass.h>
#include <wend/integrator/record_budget.h>
#include <wend/integrator/render.h>
#include <wend/integrator/schedule.h>
#include <wend/integrator/training.h>
#include <wend/integrator/path_tracer.inl>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>

namespace wend {

template class PathTracer<ClassicalDecisions>;
template class PathTracer<GuidedDecisions<guide::Field, ClassicalDistance, ClassicalSurvival>>;
template class PathTracer<GuidedDecisions<guide::Field, ClassicalDistance, AdjointSurvival>>;
template class PathTracer<GuidedDecisions<guide::Field, GuidedDistance<guide::Field>, ClassicalSurvival>>;
template class PathTracer<GuidedDecisions<guide::Field, GuidedDistance<guide::Field>, AdjointSurvival>>;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// Half of the flights follow the medium alone, whatever the guide says.
constexpr float classical_flights = 0.5f;
// Before, neither the field nor the pixels are known well enough to end or split walks by them, or to judge guides.
constexpr int warm_up_samples = 7;

void check_rejected(const WalkCounts& counts) {
    if (counts.rejected > 10 && counts.rejected * 10000 > counts.paths) {
        throw std::runtime_error(std::to_string(counts.rejected) + " of " + std::to_string(counts.paths) +
                                 " samples were not finite numbers, more than rounding can explain");
    }
}

}  // namespace

RenderStatistics render(const Scene& scene, Film& film, const RenderSettings& settings,
                        const std::function<bool(const RenderProgress&)>& keep_going) {
    const Clock::time_point start = Clock::now();
    RenderStatistics statistics;
    std::vector<Tile> tiles = tiles_of(film.crop());
    const Schedule schedule(settings);
    GuidingFields fields =
        settings.fields ? *settings.fields
                        : GuidingFields{guide::Field::empty(scene.bounds()), guide::Field::empty(scene.bounds())};

    SubsurfaceGuides subsurface(scene, settings.subsurface, settings.threads);
    LightChoices lights(scene);
    ReflectionChoices reflections(scene.bounds());
    RecordBudget budget(settings.most_records);
    for (int pass = 0;; ++pass) {
        const int count = schedule.next(pass, statistics.samples, seconds_since(start));
        if (count <= 0) {
            break;
        }
        const double walks = static_cast<double>(film.crop().width()) * film.crop().height() * count;
        const Preset& preset = settings.preset;
        const bool learning = statistics.samples < settings.training_samples;
        PassPlan plan{statistics.samples,
                      count,
                      !preset.is_classical() && learning,
                      !subsurface.is_empty() && learning,
                      preset.direction && lights.learns() && learning,
                      (preset.direction || !subsurface.is_empty()) && learning,
                      budget.share(walks),
                      {}};
        const auto run_with = [&](const auto& decisions) {
            const Pass one(scene, film, settings, decisions, subsurface, lights, reflections, plan);
            parallel_for(tiles.size(), settings.threads, [&](std::size_t i) { one.run(tiles[i]); });
        };
        const GuidedDistance distance(
            &fields.surface, &fields.volume, classical_flights,
            preset.distance ? DistanceGuiding::scatter_and_distance : DistanceGuiding::scatter_alone);
        const GuidedDirection direction(&fields.surface, &fields.volume,
                                        preset.direction ? std::nullopt : std::optional(1.0f));
        const auto run_guided = [&](const auto& survival) {
            if (preset.guides_distance()) {
                run_with(GuidedDecisions{distance, direction, survival});
            } else {
                run_with(GuidedDecisions{ClassicalDistance(), direction, survival});
            }
        };
        if (preset.guides_survival() && statistics.samples >= warm_up_samples && settings.exposure > 0) {
            plan.estimates = pixel_estimates(film.beauty(), statistics.samples);
            for (float& estimate : plan.estimates) {
                estimate /= settings.exposure;
            }
            const double sample_variance = std::pow(film.relative_noise(), 2) * statistics.samples;
            run_guided(AdjointSurvival(preset.roulette, preset.splitting, sample_variance));
        } else if (!preset.is_classical()) {
            run_guided(guided_walks_end);
        } else {
            run_with(ClassicalDecisions{});
        }
        statistics.samples += count;
        statistics.passes.push_back(count);
        if (plan.record) {
            const Clock::time_point training_start = Clock::now();
            std::vector<guide::PathRecords> records(tiles.size());
            std::size_t told = 0;
            for (std::size_t i = 0; i < tiles.size(); ++i) {
                records[i] = std::exchange(tiles[i].records, {});
                told += records[i].size();
            }
            budget.learn(plan.recorded_share * walks, static_cast<double>(told));
            if (settings.on_records) {
                settings.on_records(records);
            }
            fields = learn(fields, std::move(records), settings.threads);
            statistics.training_seconds += seconds_since(training_start);
        }
        if (plan.record_stays) {
            StayMoments moments;
            for (Tile& tile : tiles) {
                moments += std::exchange(tile.stays, {});
            }
            const bool knows_field = preset.direction && statistics.samples >= warm_up_samples;
            const NextStays lessons = knows_field ? NextStays::beside_field : NextStays::beside_classical;
            subsurface.learn(moments, statistics.samples >= settings.training_samples ? NextStays::rendering : lessons);
        }
        if (plan.record_lights) {
            for (Tile& tile : tiles) {
                lights.add(std::exchange(tile.lights, {}));
            }
            lights.learn(settings.threads);
        }
        if (plan.record_reflections) {
            for (Tile& tile : tiles) {
                reflections.add(std::exchange(tile.reflections, {}));
            }
            reflections.learn();
        }
        // The next pass will sample in another way: what it learned from has changed, or survival begins to follow it.
        const bool warms_up = !preset.is_classical() && plan.first < warm_up_samples;
        if (statistics.samples >= warm_up_samples && (plan.record || plan.record_stays || warms_up)) {
            film.begin_stage();
        }
        const double elapsed = seconds_since(start);
        if (keep_going && !keep_going({schedule.fraction(statistics.samples, elapsed), elapsed, statistics.samples,
                                       film.relative_noise()})) {
            statistics.interrupted = true;
            break;
        }
    }
    for (const Tile& tile : tiles) {
        statistics.counts += tile.counts;
    }
    if (!settings.preset.is_classical()) {
        statistics.field_bytes = fields.bytes();
        statistics.fields = std::make_shared<const GuidingFields>(std::move(fields));
    }
    statistics.seconds = seconds_since(start);
    check_rejected(statistics.counts);
    return statistics;
}

}  // namespace wend
