#include <wend/core/parallel.h>
#include <wend/film/pixel_estimate.h>
#include <wend/guide/fields.h>
#include <wend/render/pass.h>
#include <wend/render/record_budget.h>
#include <wend/render/render.h>
#include <wend/render/schedule.h>
#include <wend/transport/path_tracer.inl>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <condition_variable>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <stop_token>
#include <string>
#include <thread>
#include <utility>

namespace wend {

template class PathTracer<ClassicalDecisions>;
template class PathTracer<GuidedDecisions<guide::Field, ClassicalDistance, ClassicalRoulette>>;
template class PathTracer<GuidedDecisions<guide::Field, ClassicalDistance, AdjointRouletteSplitting>>;
template class PathTracer<GuidedDecisions<guide::Field, GuidedDistance<guide::Field>, ClassicalRoulette>>;
template class PathTracer<GuidedDecisions<guide::Field, GuidedDistance<guide::Field>, AdjointRouletteSplitting>>;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// A quarter of the flights follow the medium alone, whatever the guide says (docs/theory/distance.md).
constexpr float classical_flights = 0.25f;
// Of a walk that is not split, guided through grids. Where it is, it goes on in numbers from where much is scattered,
// which brings as much as to be there more often, for less (docs/theory/distance.md).
constexpr int flights_in_grids = 1;
// Photons from lights to smooth surfaces: as many as there have been walks, between these.
constexpr int fewest_photons = 1 << 14, most_photons = 1 << 20;
// Before, neither the field nor the pixels are known well enough to end or split walks by them, or to judge guides.
constexpr int warm_up_samples = 7;

void check_rejected(const WalkCounts& counts) {
    if (counts.rejected > 10 && counts.rejected * 10000 > counts.paths) {
        throw std::runtime_error(std::to_string(counts.rejected) + " of " + std::to_string(counts.paths) +
                                 " samples were not finite numbers, more than rounding can explain");
    }
}

/// Looks, beside the walks, at what may stop them, so that they look at one flag and no clock.
class Watch {
public:
    /// `asked` may be null.
    explicit Watch(const std::atomic<bool>* asked)
        : asked_(asked), thread_([this](const std::stop_token& ends) { run(ends); }) {}

    const std::atomic<bool>& stop() const { return stop_; }
    void stop_at(Clock::time_point time) {
        const std::scoped_lock lock(mutex_);
        end_ = time;
    }

private:
    void run(const std::stop_token& ends) {
        constexpr std::chrono::milliseconds rest(50);
        std::unique_lock lock(mutex_);
        while (!ends.stop_requested() && !stop_) {
            stop_ = (asked_ && *asked_) || (end_ && Clock::now() > *end_);
            wake_.wait_for(lock, ends, rest, [] { return false; });
        }
    }

    const std::atomic<bool>* asked_;
    std::atomic<bool> stop_ = false;
    std::mutex mutex_;
    std::condition_variable_any wake_;
    std::optional<Clock::time_point> end_;
    std::jthread thread_;  ///< last: it uses all the others
};

/// A render between its passes: what walks are guided by, and what the last pass told.
class Rendering {
public:
    Rendering(const Scene& scene, Film& film, const RenderSettings& settings, const std::atomic<bool>& stop)
        : scene_(scene),
          film_(film),
          settings_(settings),
          stop_(stop),
          tiles_(tiles_of(film.crop())),
          fields_(settings.fields
                      ? *settings.fields
                      : guide::Fields{guide::Field::empty(scene.bounds()), guide::Field::empty(scene.bounds())}),
          subsurface_(scene, settings.subsurface, settings.threads),
          lights_(scene),
          reflections_(scene.bounds()),
          budget_(settings.most_records) {}

    /// Adds `count` samples to each pixel, and learns from them.
    void pass(int count, RenderStatistics& statistics) {
        const PassPlan plan = plan_for(count, statistics.samples);
        if (plan.record && settings_.preset.direction) {
            send_photons(plan);
        }
        walk(plan);
        if (stop_) {
            return;
        }
        statistics.samples += count;
        statistics.passes.push_back(count);
        if (plan.record) {
            const Clock::time_point start = Clock::now();
            learn_fields(plan);
            statistics.training_seconds += seconds_since(start);
        }
        learn_choices(plan, statistics.samples);
        // The next pass will sample in another way: what it learned from has changed, or survival begins to follow it.
        const bool warms_up = !settings_.preset.is_classical() && plan.first < warm_up_samples;
        if (statistics.samples >= warm_up_samples && (plan.record || plan.record_interior_walks || warms_up)) {
            film_.begin_stage();
        }
    }

    void finish(RenderStatistics& statistics) {
        for (const Tile& tile : tiles_) {
            statistics.counts += tile.counts;
        }
        if (!settings_.preset.is_classical()) {
            statistics.field_bytes = fields_.bytes();
            statistics.fields = std::make_shared<const guide::Fields>(std::move(fields_));
        }
    }

private:
    double walks(const PassPlan& plan) const {
        return static_cast<double>(film_.crop().width()) * film_.crop().height() * plan.count;
    }

    PassPlan plan_for(int count, int samples) const {
        const Preset& preset = settings_.preset;
        const bool learning = samples < settings_.training_samples;
        PassPlan plan{samples,
                      count,
                      !preset.is_classical() && learning,
                      !subsurface_.is_empty() && learning,
                      preset.direction && lights_.learns() && learning,
                      (preset.direction || !subsurface_.is_empty()) && learning,
                      1,
                      {}};
        plan.recorded_share = budget_.share(walks(plan));
        if (preset.guides_survival() && samples >= warm_up_samples && settings_.exposure > 0) {
            plan.estimates = pixel_estimates(film_.beauty(), samples);
            for (float& estimate : plan.estimates) {
                estimate /= settings_.exposure;
            }
        }
        return plan;
    }

    /// Anew, once there may be twice as many.
    void send_photons(const PassPlan& plan) {
        const double walked = static_cast<double>(film_.crop().width()) * film_.crop().height() * plan.first;
        const int due = static_cast<int>(std::clamp(walked, double{fewest_photons}, double{most_photons}));
        if (due >= 2 * photons_ || (due == most_photons && photons_ < due)) {
            caustics_ = CausticPhotons(scene_, due, settings_.seed, settings_.threads);
            photons_ = due;
        }
    }

    /// All walks of a pass, by the decisions of the preset.
    void walk(const PassPlan& plan) {
        const Preset& preset = settings_.preset;
        const auto run_with = [&](const auto& decisions) {
            const Pass one(scene_, film_, settings_, decisions, subsurface_, lights_, reflections_, caustics_, plan,
                           stop_);
            parallel_for(tiles_.size(), settings_.threads, [&](std::size_t i) { one.run(tiles_[i]); });
        };
        if (preset.is_classical()) {
            run_with(ClassicalDecisions{});
            return;
        }
        const GuidedDistance distance(
            &fields_.surface, &fields_.volume, classical_flights,
            preset.distance ? DistanceGuiding::scatter_and_distance : DistanceGuiding::scatter_alone,
            preset.splitting ? 0 : flights_in_grids);
        const GuidedDirection direction(&fields_.surface, &fields_.volume,
                                        preset.direction ? std::nullopt : std::optional(1.0f), &caustics_.on_surfaces(),
                                        &caustics_.in_media());
        const auto run_guided = [&](const auto& survival) {
            if (preset.guides_distance()) {
                run_with(GuidedDecisions{distance, direction, survival});
            } else {
                run_with(GuidedDecisions{ClassicalDistance(), direction, survival});
            }
        };
        if (plan.estimates.empty()) {
            run_guided(guided_walks_end);
        } else {
            const double sample_variance = std::pow(film_.relative_noise(), 2) * plan.first;
            run_guided(AdjointRouletteSplitting(preset.roulette, preset.splitting, sample_variance));
        }
    }

    void learn_fields(const PassPlan& plan) {
        std::vector<guide::PathRecords> records(tiles_.size());
        std::size_t told = 0;
        for (std::size_t i = 0; i < tiles_.size(); ++i) {
            records[i] = std::exchange(tiles_[i].records, {});
            told += records[i].size();
        }
        budget_.learn(plan.recorded_share * walks(plan), static_cast<double>(told));
        if (settings_.on_records) {
            settings_.on_records(records);
        }
        fields_ = guide::learn(fields_, std::move(records), settings_.threads);
    }

    /// How interior walks are sampled, which lights are connected to, and what boundaries do, after so many samples.
    void learn_choices(const PassPlan& plan, int samples) {
        if (plan.record_interior_walks) {
            SecondMoments moments;
            for (Tile& tile : tiles_) {
                moments += std::exchange(tile.interior_walks, {});
            }
            const bool knows_field = settings_.preset.direction && samples >= warm_up_samples;
            const NextWalks lessons = knows_field ? NextWalks::beside_field : NextWalks::beside_classical;
            subsurface_.learn(moments, samples >= settings_.training_samples ? NextWalks::rendering : lessons);
        }
        if (plan.record_lights) {
            for (Tile& tile : tiles_) {
                lights_.add(std::exchange(tile.lights, {}));
            }
            lights_.learn(settings_.threads);
        }
        if (plan.record_reflections) {
            for (Tile& tile : tiles_) {
                reflections_.add(std::exchange(tile.reflections, {}));
            }
            reflections_.learn();
        }
    }

    const Scene& scene_;
    Film& film_;
    const RenderSettings& settings_;
    const std::atomic<bool>& stop_;
    std::vector<Tile> tiles_;
    guide::Fields fields_;
    SubsurfaceGuides subsurface_;
    LightSelection lights_;
    ReflectionProbability reflections_;
    CausticPhotons caustics_;
    int photons_ = 0;  ///< that were sent
    RecordBudget budget_;
};

}  // namespace

RenderStatistics render(const Scene& scene, Film& film, const RenderSettings& settings,
                        const std::function<bool(const RenderProgress&)>& keep_going) {
    const Clock::time_point start = Clock::now();
    RenderStatistics statistics;
    const Schedule schedule(settings);
    Watch watch(settings.stop);
    Rendering rendering(scene, film, settings, watch.stop());
    for (int pass = 0;; ++pass) {
        const int count = schedule.next(pass, statistics.samples, seconds_since(start));
        if (count <= 0) {
            break;
        }
        if (settings.seconds > 0 && settings.passes.empty()) {
            // Longer than any render, and less than the clock can count.
            constexpr double excess = 1, first_pass = 10, longest = 1e9;
            const double most =
                std::min(longest, (settings.seconds + excess) * (statistics.samples == 0 ? first_pass : 1));
            watch.stop_at(start + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(most)));
        }
        rendering.pass(count, statistics);
        if (watch.stop()) {
            statistics.interrupted = true;
            break;
        }
        const double elapsed = seconds_since(start);
        if (keep_going && !keep_going({schedule.fraction(statistics.samples, elapsed), elapsed, statistics.samples,
                                       film.relative_noise()})) {
            statistics.interrupted = true;
            break;
        }
    }
    rendering.finish(statistics);
    statistics.seconds = seconds_since(start);
    check_rejected(statistics.counts);
    return statistics;
}

}  // namespace wend
