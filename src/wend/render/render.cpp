#include <wend/core/parallel.h>
#include <wend/decision/guided_distance.h>
#include <wend/film/pixel_estimate.h>
#include <wend/render/guiding_choice.h>
#include <wend/render/pass.h>
#include <wend/render/render.h>
#include <wend/render/schedule.h>
#include <wend/transport/path_tracer.h>

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

template class PathTracer<ClassicalDecisions, Learners::Recorders>;
template class PathTracer<GuidedDecisions<guide::Field, ClassicalDistance, ClassicalRoulette>, Learners::Recorders>;
template class PathTracer<GuidedDecisions<guide::Field, ClassicalDistance, AdjointRouletteSplitting>,
                          Learners::Recorders>;
template class PathTracer<GuidedDecisions<guide::Field, GuidedDistance<guide::Field>, ClassicalRoulette>,
                          Learners::Recorders>;
template class PathTracer<GuidedDecisions<guide::Field, GuidedDistance<guide::Field>, AdjointRouletteSplitting>,
                          Learners::Recorders>;

namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point start) {
    return std::chrono::duration<double>(Clock::now() - start).count();
}

// A quarter of the flights follow the medium alone, whatever the guide says (docs/theory/distance.md).
constexpr float classical_flights = 0.25f;

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

/// A render between its passes.
class Rendering {
public:
    Rendering(const Scene& scene, Film& film, const RenderSettings& settings, const std::atomic<bool>& stop)
        : scene_(scene),
          film_(film),
          settings_(settings),
          stop_(stop),
          context_{scene, settings, static_cast<double>(film.crop().width()) * film.crop().height()},
          tiles_(tiles_of(film.crop())),
          records_(tiles_.size()),
          learners_(context_),
          choice_(settings.preset, {has_fog(scene), learners_.get<InteriorLearner>().can_guide()},
                  settings.fields != nullptr, tiles_.size(), context_.pixels) {}

    /// Adds `count` samples to each pixel, and learns from them unless this pass `is_last`.
    void pass(int count, bool is_last, RenderStatistics& statistics) {
        const PassPlan plan = plan_for(count, is_last, statistics.samples);
        learners_.begin(plan);
        for (std::size_t i = 0; i < tiles_.size(); ++i) {
            tiles_[i].shares = choice_.shares(i, count);
            tiles_[i].tallies = {};
        }
        for (std::size_t kind = 0; kind < choice_.kinds().size() && !stop_; ++kind) {
            // By one sample a stage would not know its variance.
            if (kind > 0 && choice_.is_trial() && count >= 2 * static_cast<int>(choice_.kinds().size())) {
                film_.begin_stage();
            }
            walk(plan, kind);
        }
        if (stop_) {
            return;
        }
        statistics.samples += count;
        statistics.passes.push_back(count);
        const Clock::time_point start = Clock::now();
        learners_.learn(records_, plan);
        statistics.training_seconds += seconds_since(start);
        // The next pass will sample in another way: what it learned from has changed, or survival begins to follow it.
        const bool warms_up = !settings_.preset.is_classical() && plan.first < warm_up_samples;
        const bool chooses_anew = choose(statistics.samples);
        if (statistics.samples >= warm_up_samples && (learners_.changes_walks() || warms_up || chooses_anew)) {
            film_.begin_stage();
        }
    }

    void finish(RenderStatistics& statistics) {
        for (const Tile& tile : tiles_) {
            statistics.counts += tile.counts;
        }
        const auto means = choice_.means();
        for (std::size_t kind = 0; kind < choice_.kinds().size(); ++kind) {
            double walks = 0;
            for (const Tile& tile : tiles_) {
                walks += static_cast<double>(tile.walks[kind]);
            }
            const double all = static_cast<double>(std::max<std::uint64_t>(statistics.counts.paths, 1));
            statistics.kinds.push_back({choice_.kinds()[kind], walks / all, means[kind].square, means[kind].work});
        }
        if (!settings_.preset.is_classical()) {
            statistics.fields = std::make_shared<const guide::Fields>(learners_.get<FieldLearner>().take_fields());
            statistics.field_bytes = statistics.fields->bytes();
        }
    }

private:
    PassPlan plan_for(int count, bool is_last, int samples) const {
        const Preset& preset = settings_.preset;
        PassPlan plan;
        plan.first = samples;
        plan.count = count;
        plan.learns =
            samples < settings_.training_samples && !(is_last && choice_.kinds().size() > 1 && !settings_.keeps_fields);
        plan.guides = choice_.guides(count);
        plan.steers = preset.direction || learners_.get<InteriorLearner>().can_guide();
        // In a small picture the fields would learn from too few.
        constexpr double fewest_recorded = 1024;
        const double walks = context_.walks(plan);
        plan.recorded_share = std::min(learners_.get<FieldLearner>().recorded_share(walks),
                                       std::max(choice_.recorded_share(samples), fewest_recorded / walks));
        if (preset.guides_survival() && samples >= warm_up_samples && settings_.exposure > 0) {
            plan.estimates = pixel_estimates(film_.beauty(), samples);
            for (float& estimate : plan.estimates) {
                estimate /= settings_.exposure;
            }
        }
        return plan;
    }

    /// By what the pass has shown, the kinds of walks to come; whether that changes anything.
    bool choose(int samples) {
        std::vector<WalkTallies> tallies;
        tallies.reserve(tiles_.size());
        for (const Tile& tile : tiles_) {
            tallies.push_back(tile.tallies);
        }
        return choice_.learn(tallies, samples >= warm_up_samples, learners_.get<FieldLearner>().records());
    }

    /// All walks of one kind in a pass.
    void walk(const PassPlan& plan, std::size_t kind) {
        const Preset& preset = choice_.kinds()[kind].preset;
        const auto run_with = [&](const auto& decisions) {
            const Pass one(scene_, film_, settings_, decisions, choice_, kind, learners_, plan, stop_);
            parallel_for(tiles_.size(), settings_.threads, [&](std::size_t i) { one.run(tiles_[i], records_[i]); });
        };
        if (preset.is_classical()) {
            const bool ends_early = settings_.preset.is_classical();
            run_with(ClassicalDecisions{{}, {}, ends_early ? ClassicalRoulette() : unguided_walks_end});
            return;
        }
        const auto& learned = learners_.get<FieldLearner>();
        const guide::Fields& fields = learned.fields();
        const GuidedDistance distance(
            &fields.surface, &fields.volume, classical_flights,
            preset.distance ? DistanceGuiding::scatter_and_distance : DistanceGuiding::scatter_alone);
        const GuidedDirection direction(&fields.surface, &fields.volume,
                                        preset.direction ? std::nullopt : std::optional(1.0f),
                                        preset.direction ? &learned.surface_caustics() : nullptr,
                                        preset.direction ? &learned.volume_caustics() : nullptr);
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

    const Scene& scene_;
    Film& film_;
    const RenderSettings& settings_;
    const std::atomic<bool>& stop_;
    LearningContext context_;
    std::vector<Tile> tiles_;
    std::vector<Learners::Records> records_;  ///< by tile
    Learners learners_;
    GuidingChoice choice_;
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
        rendering.pass(count, schedule.is_last(pass, statistics.samples + count), statistics);
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
