#include <wend/app/comparison.h>

#include <wend/app/progress.h>
#include <wend/core/error.h>
#include <wend/film/flip.h>

#include <fmt/format.h>

#include <algorithm>
#include <memory>
#include <numeric>
#include <utility>

namespace wend {
namespace {

/// One render of one preset with one seed.
struct Run {
    ComparisonRun numbers;
    std::vector<WalkKindStatistics> kinds;
    Image image;
    std::vector<Layer> walks;
    ErrorTerms errors;
};

/// A picture on the way, to be measured when the clock has stopped.
struct Snapshot {
    double seconds, samples, work;
    Image image;
};

/// Renders with the settings; returns pictures at times that double.
std::vector<Snapshot> render_with_snapshots(const Session& session, Film& film, const RenderSettings& settings,
                                            const std::function<void(const RenderProgress&)>& watch,
                                            RenderStatistics& statistics) {
    std::vector<Snapshot> snapshots;
    double next_snapshot = 0;
    Render render(session.scene(), film, settings);
    for (bool goes_on = true; goes_on;) {
        goes_on = render.step(seconds_between_looks);
        const RenderProgress progress = render.progress();
        watch(progress);
        if (goes_on && !render.is_within_pass() && progress.seconds >= next_snapshot) {
            const double work = static_cast<double>(render.statistics().counts.segments);
            snapshots.push_back({progress.seconds, static_cast<double>(progress.samples), work, film.beauty()});
            next_snapshot = progress.seconds * 2;
        }
    }
    statistics = render.result();
    return snapshots;
}

Run run_once(const Session& session, const RenderSettings& settings, const Reference& reference,
             const std::function<void(const RenderProgress&)>& watch) {
    Film film = session.new_film(settings);
    RenderStatistics statistics;
    std::vector<Snapshot> snapshots = render_with_snapshots(session, film, settings, watch, statistics);
    const double work = static_cast<double>(statistics.counts.segments);
    // Its time may have been up before another walk.
    if (!snapshots.empty() && snapshots.back().work == work) {
        snapshots.pop_back();
    }
    snapshots.push_back({statistics.seconds, static_cast<double>(statistics.samples), work, film.beauty()});

    Run run;
    run.numbers = {settings.seed, static_cast<double>(statistics.samples), statistics.seconds, work, {}, {}, {}};
    for (const Snapshot& shot : snapshots) {
        run.errors = error_terms(shot.image, reference);
        run.numbers.metrics = measure(run.errors);
        const Metrics& m = run.numbers.metrics;
        run.numbers.points.push_back({shot.seconds, m.relmse, shot.samples, shot.work, m.relmse_trimmed});
    }
    run.image = std::move(snapshots.back().image);
    run.walks = film.walk_layers();
    run.kinds = statistics.kinds;
    return run;
}

/// firefly_error() over the pixels of all runs.
double pooled_firefly_error(const std::vector<Run>& runs) {
    std::vector<float> errors;
    for (const Run& run : runs) {
        const std::vector<float> of_run = to_floats(run.errors.relative_squared);
        errors.insert(errors.end(), of_run.begin(), of_run.end());
    }
    return firefly_error(std::move(errors));
}

/// Of an odd number of runs the median by relMSE, of an even number the worse of the two in the middle.
std::size_t median_run(const std::vector<Run>& runs) {
    std::vector<std::size_t> order(runs.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
        return runs[a].numbers.metrics.relmse < runs[b].numbers.metrics.relmse;
    });
    return order[order.size() / 2];
}

ErrorTerms mean_errors(const std::vector<Run>& runs) {
    MeanErrors errors;
    for (const Run& run : runs) {
        errors.add(run.errors);
    }
    return errors.mean();
}

ComparisonRow row_of(const WayOfSampling& way, std::vector<Run> runs, const Reference& reference) {
    const std::size_t median = median_run(runs);
    Run& shown = runs[median];
    ComparisonRow row;
    row.way = way;
    row.samples = shown.numbers.samples;
    row.seconds = shown.numbers.seconds;
    row.work = shown.numbers.work;
    row.metrics = shown.numbers.metrics;
    row.metrics.error_p9999 = pooled_firefly_error(runs);
    row.flip = flip(shown.image, reference.average()).mean;
    row.image = std::move(shown.image);
    row.errors = mean_errors(runs);
    row.walks = std::move(shown.walks);
    row.kinds = shown.kinds;
    row.convergence = {to_string(way), shown.numbers.points};
    for (std::size_t i = 0; i < runs.size(); ++i) {
        if (i != median) {
            row.convergence.others.push_back(runs[i].numbers.points);
        }
        row.runs.push_back(std::move(runs[i].numbers));
    }
    return row;
}

/// Error times time of one over that of another.
double gain(double first_error, double first_seconds, double second_error, double second_seconds) {
    return first_error * first_seconds / (second_error * second_seconds);
}

void add_ratios(std::vector<ComparisonRow>& rows) {
    const auto classical =
        std::find_if(rows.begin(), rows.end(), [](const ComparisonRow& r) { return r.way.is_classical(); });
    if (classical == rows.end()) {
        return;
    }
    for (ComparisonRow& row : rows) {
        row.ratio = gain(classical->metrics.relmse, classical->seconds, row.metrics.relmse, row.seconds);
        for (std::size_t i = 0; i < row.runs.size(); ++i) {
            const ComparisonRun& first = classical->runs[i];
            ComparisonRun& run = row.runs[i];
            run.ratio = gain(first.metrics.relmse, first.seconds, run.metrics.relmse, run.seconds);
        }
    }
}

}  // namespace

std::string to_string(const WayOfSampling& way) {
    const std::string name = to_string(way.preset);
    return way.subsurface == SubsurfacePreset() ? name : name + "/" + to_string(way.subsurface);
}

ComparisonWatcher comparison_bars(int seeds, const CommonOptions& common, const Streams& streams,
                                  const std::string& label) {
    return [bars = std::make_shared<ProgressOfRenders>(streams.err, !common.quiet), seeds, label](
               const WayOfSampling& way, int seed, const RenderProgress& progress) {
        bars->update(fmt::format("{}{} {}/{}", label, to_string(way), seed + 1, seeds), progress);
    };
}

Comparison compare_presets(const Session& session, const ComparisonPlan& plan, KnownReference reference,
                           const ComparisonWatcher& watcher) {
    const PixelRect crop = session.new_film(session.settings()).crop();
    const std::string problem = size_problem(reference, {crop.width(), crop.height()});
    if (!problem.empty()) {
        throw InputError(problem + ": choose a resolution to match, or have a reference rendered");
    }
    std::vector<std::vector<Run>> runs(plan.ways.size());
    for (int seed = 0; seed < plan.seeds; ++seed) {
        for (std::size_t p = 0; p < plan.ways.size(); ++p) {
            const WayOfSampling& way = plan.ways[p];
            RenderSettings settings = session.settings();
            settings.preset = way.preset;
            settings.subsurface = way.subsurface;
            settings.seconds = plan.seconds;
            settings.seed += static_cast<std::uint64_t>(seed) + 1;
            watcher(way, seed, {});
            runs[p].push_back(run_once(session, settings, reference.halves,
                                       [&](const RenderProgress& progress) { watcher(way, seed, progress); }));
        }
    }
    Comparison result;
    result.scene = session.scene_file();
    result.settings = session.describe(session.settings());
    result.plan = plan;
    for (std::size_t p = 0; p < plan.ways.size(); ++p) {
        result.rows.push_back(row_of(plan.ways[p], std::move(runs[p]), reference.halves));
    }
    add_ratios(result.rows);
    result.reference = std::move(reference);
    return result;
}

}  // namespace wend
