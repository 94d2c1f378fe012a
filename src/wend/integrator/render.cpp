#include <wend/core/parallel.h>
#include <wend/film/pixel_estimate.h>
#include <wend/integrator/render.h>
#include <wend/integrator/training.h>
#include <wend/integrator/path_tracer.inl>

#include <algorithm>
#include <chrono>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>

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
constexpr int largest_pass = 32;
// Before, neither the field nor the pixels are known well enough to end or split walks by them.
constexpr int warm_up_samples = 7;
// More vertices of one walk say little that is new: they are correlated.
constexpr std::size_t most_records = 64;

/// A block of pixels, rendered by one thread at a time.
struct Tile {
    PixelRect pixels;
    WalkCounts counts;
    guide::PathRecords records;
    StayMoments stays;
};

std::vector<Tile> tiles_of(const PixelRect& crop) {
    constexpr int side = 16;
    std::vector<Tile> tiles;
    for (int y = crop.min.y; y < crop.max.y; y += side) {
        for (int x = crop.min.x; x < crop.max.x; x += side) {
            tiles.push_back({{{x, y}, {std::min(x + side, crop.max.x), std::min(y + side, crop.max.y)}}, {}, {}, {}});
        }
    }
    return tiles;
}

/// What one pass does.
struct PassPlan {
    int first;  ///< sample of each pixel
    int count;
    bool record;
    bool record_stays;
    /// Of each pixel of the crop, without exposure; empty where not known.
    std::vector<float> estimates;
};

/// One pass, with the same decisions for all walks.
template <class Decisions>
class Pass {
public:
    Pass(const Scene& scene, Film& film, const RenderSettings& settings, const Decisions& decisions,
         const SubsurfaceGuides& subsurface, const PassPlan& plan)
        : tracer_(scene, decisions, subsurface, settings.max_depth),
          subsurface_(subsurface),
          camera_(scene.camera()),
          film_(film),
          settings_(settings),
          plan_(plan) {}

    void run(Tile& tile) const {
        guide::PathLog log;
        std::vector<Stay> stays;
        for (int y = tile.pixels.min.y; y < tile.pixels.max.y; ++y) {
            for (int x = tile.pixels.min.x; x < tile.pixels.max.x; ++x) {
                for (int i = 0; i < plan_.count; ++i) {
                    sample({x, y}, plan_.first + i, tile, log, stays);
                }
            }
        }
    }

private:
    void sample(const Vec2i& pixel, int index, Tile& tile, guide::PathLog& log, std::vector<Stay>& stays) const {
        const auto number = static_cast<std::uint64_t>(pixel.y) * static_cast<std::uint64_t>(film_.full_size().x) +
                            static_cast<std::uint64_t>(pixel.x);
        Sampler sampler(settings_.sampler, settings_.seed, number, static_cast<std::uint32_t>(index));
        const Filter::Sample place = settings_.filter.sample(sampler.uniform2());
        const Vec2 film_point(static_cast<float>(pixel.x) + 0.5f + place.offset.x,
                              static_cast<float>(pixel.y) + 0.5f + place.offset.y);
        const Ray ray = camera_.ray(film_point, sampler.uniform2());
        WalkResult result = tracer_.trace(ray, estimate(pixel), sampler, plan_.record ? &log : nullptr,
                                          plan_.record_stays ? &stays : nullptr);
        for (const Stay& stay : std::exchange(stays, {})) {
            subsurface_.count(stay, tile.stays);
        }
        ++tile.counts.paths;
        tile.counts.segments += result.sample.segments;
        if (!is_finite(result.sample.radiance)) {
            ++tile.counts.rejected;
            film_.reject(pixel);
            return;
        }
        if (plan_.record) {
            tile.records.add(log.vertices(), most_records);
        }
        result.sample.radiance *= place.weight * settings_.exposure;
        film_.add(pixel, result.sample);
    }

    float estimate(const Vec2i& pixel) const {
        const PixelRect& crop = film_.crop();
        return plan_.estimates.empty() ? 0.0f
                                       : plan_.estimates[static_cast<std::size_t>(pixel.y - crop.min.y) *
                                                             static_cast<std::size_t>(crop.width()) +
                                                         static_cast<std::size_t>(pixel.x - crop.min.x)];
    }

    PathTracer<Decisions> tracer_;
    const SubsurfaceGuides& subsurface_;
    const Camera& camera_;
    Film& film_;
    const RenderSettings& settings_;
    const PassPlan& plan_;
};

/// Plans the passes: doubling while the field learns, then as long as time or samples allow.
class Schedule {
public:
    explicit Schedule(const RenderSettings& settings) : settings_(settings) {}

    /// Samples per pixel of the next pass; 0 at the end.
    int next(int pass, int done, double elapsed) const {
        if (!settings_.passes.empty()) {
            return pass < static_cast<int>(settings_.passes.size()) ? settings_.passes[static_cast<std::size_t>(pass)]
                                                                    : 0;
        }
        const int wanted = std::min(largest_pass, 1 << std::min(pass, 5));
        if (settings_.seconds <= 0) {
            return std::min(wanted, settings_.samples - done);
        }
        if (done == 0) {
            return 1;
        }
        // What fits into the time that is left, at the pace so far; a last pass may be up to a third short of one
        // sample.
        const double left = (settings_.seconds - elapsed) * done / elapsed;
        return left < 0.67 ? 0 : static_cast<int>(std::clamp(left, 1.0, static_cast<double>(wanted)));
    }

    double fraction(int done, double elapsed) const {
        if (!settings_.passes.empty()) {
            int total = 0;
            for (const int pass : settings_.passes) {
                total += pass;
            }
            return static_cast<double>(done) / std::max(1, total);
        }
        return std::min(1.0, settings_.seconds > 0 ? elapsed / settings_.seconds
                                                   : static_cast<double>(done) / std::max(1, settings_.samples));
    }

private:
    const RenderSettings& settings_;
};

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
    for (int pass = 0;; ++pass) {
        const int count = schedule.next(pass, statistics.samples, seconds_since(start));
        if (count <= 0) {
            break;
        }
        const Preset& preset = settings.preset;
        const bool learning = statistics.samples < settings.training_samples;
        PassPlan plan{
            statistics.samples, count, !preset.is_classical() && learning, !subsurface.is_empty() && learning, {}};
        const auto run_with = [&](const auto& decisions) {
            const Pass one(scene, film, settings, decisions, subsurface, plan);
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
            run_guided(AdjointSurvival(preset.roulette, preset.splitting));
        } else if (!preset.is_classical()) {
            run_guided(ClassicalSurvival());
        } else {
            run_with(ClassicalDecisions{});
        }
        statistics.samples += count;
        statistics.passes.push_back(count);
        if (plan.record) {
            const Clock::time_point training_start = Clock::now();
            std::vector<guide::PathRecords> records(tiles.size());
            for (std::size_t i = 0; i < tiles.size(); ++i) {
                records[i] = std::exchange(tiles[i].records, {});
            }
            if (settings.on_records) {
                settings.on_records(records);
            }
            fields = learn(fields, records, settings.threads);
            statistics.training_seconds += seconds_since(training_start);
        }
        if (plan.record_stays) {
            StayMoments moments;
            for (Tile& tile : tiles) {
                moments += std::exchange(tile.stays, {});
            }
            subsurface.learn(moments, statistics.samples >= settings.training_samples);
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
