#include <wend/app/comparison.h>
#include <wend/app/progress.h>
#include <wend/app/text_table.h>
#include <wend/core/error.h>
#include <wend/film/flip.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <memory>
#include <utility>

namespace wend {
namespace {

/// One render of one preset with one seed.
struct Run {
    RenderStatistics statistics;
    Image image;
    std::vector<Layer> walks;
    Metrics metrics;
    std::vector<float> errors;
    std::vector<ConvergenceSeries::Point> points;
};

Run run_once(const Session& session, const RenderSettings& settings, const Reference& reference,
             const std::function<void(const RenderProgress&)>& watch) {
    Film film = session.new_film(settings);
    // Pictures on the way are kept at times that double, and measured when the clock has stopped.
    std::vector<std::pair<double, Image>> snapshots;
    double next_snapshot = 0;
    Run run;
    run.statistics = render(session.scene(), film, settings, [&](const RenderProgress& progress) {
        watch(progress);
        if (progress.seconds >= next_snapshot) {
            snapshots.emplace_back(progress.seconds, film.beauty());
            next_snapshot = progress.seconds * 2;
        }
        return true;
    });
    run.image = film.beauty();
    run.walks = film.walk_layers();
    run.metrics = measure(run.image, reference);
    run.errors = relative_squared_errors(run.image, reference);
    for (const auto& [seconds, image] : snapshots) {
        run.points.push_back({seconds, measure(image, reference).relmse});
    }
    run.points.push_back({run.statistics.seconds, run.metrics.relmse});
    return run;
}

/// firefly_error() over the pixels of all runs.
double pooled_firefly_error(const std::vector<Run>& runs) {
    std::vector<float> errors;
    for (const Run& run : runs) {
        errors.insert(errors.end(), run.errors.begin(), run.errors.end());
    }
    return firefly_error(std::move(errors));
}

}  // namespace

std::string to_string(const WayOfSampling& way) {
    const std::string name = to_string(way.preset);
    return way.subsurface == SubsurfacePreset() ? name : name + "/" + to_string(way.subsurface);
}

ComparisonWatcher comparison_bars(int seeds, const CommonOptions& common, const Streams& streams) {
    return [bars = std::make_shared<ProgressOfRenders>(streams.err, !common.quiet), seeds](
               const WayOfSampling& way, int seed, const RenderProgress& progress) {
        bars->update(fmt::format("{} {}/{}", to_string(way), seed + 1, seeds), progress);
    };
}

std::vector<ComparisonRow> compare_presets(const Session& session, const std::vector<WayOfSampling>& ways,
                                           double seconds, int seeds, const Reference& reference,
                                           const ComparisonWatcher& watcher) {
    const Film film = session.new_film(session.settings());
    if (reference.a.width != film.crop().width() || reference.a.height != film.crop().height()) {
        throw InputError(
            fmt::format("the reference has {} x {} pixels, the picture {} x {}: choose --resolution to match",
                        reference.a.width, reference.a.height, film.crop().width(), film.crop().height()));
    }
    std::vector<std::vector<Run>> runs(ways.size());
    for (int seed = 0; seed < seeds; ++seed) {
        for (std::size_t p = 0; p < ways.size(); ++p) {
            RenderSettings settings = session.settings();
            settings.preset = ways[p].preset;
            settings.subsurface = ways[p].subsurface;
            settings.seconds = seconds;
            settings.seed += static_cast<std::uint64_t>(seed) + 1;
            watcher(ways[p], seed, {});
            runs[p].push_back(run_once(session, settings, reference,
                                       [&](const RenderProgress& progress) { watcher(ways[p], seed, progress); }));
        }
    }
    std::vector<ComparisonRow> rows;
    for (std::size_t p = 0; p < ways.size(); ++p) {
        std::vector<std::size_t> order(runs[p].size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            order[i] = i;
        }
        std::sort(order.begin(), order.end(),
                  [&](std::size_t a, std::size_t b) { return runs[p][a].metrics.relmse < runs[p][b].metrics.relmse; });
        const std::size_t median = order[order.size() / 2];
        Run& run = runs[p][median];
        ComparisonRow row;
        row.way = ways[p];
        row.samples = run.statistics.samples;
        row.seconds = run.statistics.seconds;
        row.metrics = run.metrics;
        row.metrics.error_p9999 = pooled_firefly_error(runs[p]);
        row.flip = flip(run.image, reference.average()).mean;
        row.image = std::move(run.image);
        row.walks = std::move(run.walks);
        row.kinds = run.statistics.kinds;
        row.convergence = {to_string(ways[p]), run.points};
        for (Run& one : runs[p]) {
            row.runs.push_back({static_cast<double>(one.statistics.samples), one.statistics.seconds, one.metrics,
                                std::move(one.points)});
        }
        rows.push_back(std::move(row));
    }
    const auto classical =
        std::find_if(rows.begin(), rows.end(), [](const ComparisonRow& r) { return r.way.is_classical(); });
    if (classical != rows.end()) {
        for (ComparisonRow& row : rows) {
            row.ratio = classical->metrics.relmse * classical->seconds / (row.metrics.relmse * row.seconds);
        }
    }
    return rows;
}

nlohmann::json kinds_json(const std::vector<WalkKindStatistics>& kinds) {
    nlohmann::json list = nlohmann::json::array();
    for (const WalkKindStatistics& kind : kinds) {
        const double price = kind.squared_error * kind.work, first = kinds[0].squared_error * kinds[0].work;
        list.push_back({{"sampling", to_string(kind.kind.preset)},
                        {"subsurface", kind.kind.guides_dense_media},
                        {"share", kind.share},
                        {"squared_error", json_number(kind.squared_error)},
                        {"work", json_number(kind.work)},
                        {"gain", price > 0 && first > 0 ? json_number(first / price) : nlohmann::json(nullptr)}});
    }
    return list;
}

namespace {

/// Of walks, those that were guided.
double guided_share(const std::vector<WalkKindStatistics>& kinds) {
    double share = 0;
    for (const WalkKindStatistics& kind : kinds) {
        share += kind.kind.is_classical() ? 0.0 : kind.share;
    }
    return share;
}

}  // namespace

std::string comparison_table(const std::vector<ComparisonRow>& rows) {
    std::vector<std::vector<std::string>> table = {
        {"sampling", "", "spp", "guided", "seconds", "relMSE", "trimmed", "99.99 %", "FLIP", "ratio"}};
    for (const ComparisonRow& r : rows) {
        const Metrics& m = r.metrics;
        table.push_back({to_string(r.way), ablation_role(r.way.preset), fmt::format("{:.0f}", r.samples),
                         fmt::format("{:.0f} %", 100 * guided_share(r.kinds)), fmt::format("{:.2f}", r.seconds),
                         fmt::format("{:.4g}", m.relmse), fmt::format("{:.4g}", m.relmse_trimmed),
                         fmt::format("{:.4g}", m.error_p9999), fmt::format("{:.4f}", r.flip),
                         r.ratio ? fmt::format("{:.2f}", *r.ratio) : "-"});
    }
    return text_table(table, 2);
}

nlohmann::json comparison_json(const std::vector<ComparisonRow>& rows) {
    nlohmann::json list = nlohmann::json::array();
    for (const ComparisonRow& r : rows) {
        list.push_back({{"sampling", to_string(r.way)},
                        {"spp", r.samples},
                        {"seconds", r.seconds},
                        {"relmse", json_number(r.metrics.relmse)},
                        {"relmse_trimmed", json_number(r.metrics.relmse_trimmed)},
                        {"error_p9999", json_number(r.metrics.error_p9999)},
                        {"mse", json_number(r.metrics.mse)},
                        {"mape", json_number(r.metrics.mape)},
                        {"flip", json_number(r.flip)},
                        {"guiding", kinds_json(r.kinds)},
                        {"ratio", r.ratio ? json_number(*r.ratio) : nlohmann::json(nullptr)}});
    }
    return list;
}

}  // namespace wend
