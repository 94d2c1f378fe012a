#include <wend/app/comparison_data.h>

#include <wend/app/text_table.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace wend {
namespace {

using Cells = std::vector<std::string>;

/// Of walks, those that were guided.
double guided_share(const std::vector<WalkKindStatistics>& kinds) {
    double share = 0;
    for (const WalkKindStatistics& kind : kinds) {
        share += kind.kind.is_classical() ? 0.0 : kind.share;
    }
    return share;
}

/// A number of a run, over the runs.
template <class Value>
Spread spread_over(const ComparisonRow& row, const Value& value) {
    std::vector<double> values;
    for (const ComparisonRun& run : row.runs) {
        values.push_back(value(run));
    }
    return spread_of(std::move(values));
}

nlohmann::json spread_json(const Spread& s) {
    return {{"count", s.count},          {"median", json_number(s.median)}, {"min", json_number(s.min)},
            {"max", json_number(s.max)}, {"mean", json_number(s.mean)},     {"std_error", json_number(s.std_error)}};
}

nlohmann::json optional_number(const std::optional<double>& value) {
    return value ? json_number(*value) : nlohmann::json(nullptr);
}

nlohmann::json metrics_json(const Metrics& m) {
    return {{"relmse", json_number(m.relmse)},
            {"relmse_std_error", json_number(m.relmse_std_error)},
            {"relmse_trimmed", json_number(m.relmse_trimmed)},
            {"error_p9999", json_number(m.error_p9999)},
            {"mse", json_number(m.mse)},
            {"mape", json_number(m.mape)}};
}

nlohmann::json run_json(const ComparisonRun& run) {
    nlohmann::json points = nlohmann::json::array();
    for (const ConvergenceSeries::Point& p : run.points) {
        points.push_back({{"spp", p.samples},
                          {"seconds", p.seconds},
                          {"work", p.work},
                          {"relmse", json_number(p.relmse)},
                          {"relmse_trimmed", json_number(p.relmse_trimmed)}});
    }
    nlohmann::json json = {{"seed", run.seed},
                           {"spp", run.samples},
                           {"seconds", run.seconds},
                           {"work", run.work},
                           {"ratio", optional_number(run.ratio)},
                           {"points", std::move(points)}};
    json.update(metrics_json(run.metrics));
    return json;
}

nlohmann::json row_json(const ComparisonRow& r, const std::string& scene) {
    nlohmann::json runs = nlohmann::json::array();
    for (const ComparisonRun& run : r.runs) {
        runs.push_back(run_json(run));
    }
    const auto trimmed = [](const ComparisonRun& run) { return run.metrics.relmse_trimmed; };
    nlohmann::json json = {
        {"scene", scene},
        {"sampling", to_string(r.way)},
        {"spp", r.samples},
        {"seconds", r.seconds},
        {"work", r.work},
        {"flip", json_number(r.flip)},
        {"guiding", kinds_json(r.kinds)},
        {"ratio", optional_number(r.ratio)},
        {"spread",
         {{"relmse", spread_json(relmse_spread(r))},
          {"relmse_trimmed", spread_json(spread_over(r, trimmed))},
          {"spp", spread_json(spread_over(r, [](const ComparisonRun& run) { return run.samples; }))},
          {"seconds", spread_json(spread_over(r, [](const ComparisonRun& run) { return run.seconds; }))},
          {"ratio", spread_json(ratio_spread(r))}}},
        {"runs", std::move(runs)}};
    json.update(metrics_json(r.metrics));
    return json;
}

std::string csv_number(double value) {
    return std::isfinite(value) ? fmt::format("{}", value) : "";
}

/// The row's cells with more of them.
void append(Cells& cells, std::initializer_list<double> values) {
    for (const double value : values) {
        cells.push_back(csv_number(value));
    }
}

constexpr double none = std::numeric_limits<double>::quiet_NaN();

}  // namespace

Spread relmse_spread(const ComparisonRow& row) {
    return spread_over(row, [](const ComparisonRun& run) { return run.metrics.relmse; });
}

Spread ratio_spread(const ComparisonRow& row) {
    return spread_over(row, [](const ComparisonRun& run) { return run.ratio.value_or(none); });
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

std::string comparison_table(const std::vector<ComparisonRow>& rows) {
    std::vector<Cells> table = {
        {"sampling", "", "spp", "guided", "seconds", "relMSE", "least", "most", "trimmed", "99.99 %", "FLIP", "ratio"}};
    for (const ComparisonRow& r : rows) {
        const Metrics& m = r.metrics;
        const Spread spread = relmse_spread(r);
        table.push_back({to_string(r.way), ablation_role(r.way.preset), fmt::format("{:.0f}", r.samples),
                         fmt::format("{:.0f} %", 100 * guided_share(r.kinds)), fmt::format("{:.2f}", r.seconds),
                         fmt::format("{:.4g}", m.relmse), fmt::format("{:.4g}", spread.min),
                         fmt::format("{:.4g}", spread.max), fmt::format("{:.4g}", m.relmse_trimmed),
                         fmt::format("{:.4g}", m.error_p9999), fmt::format("{:.4f}", r.flip),
                         r.ratio ? fmt::format("{:.2f}", *r.ratio) : "-"});
    }
    return text_table(table, 2);
}

nlohmann::json comparison_json(const Comparison& comparison) {
    nlohmann::json list = nlohmann::json::array();
    for (const ComparisonRow& row : comparison.rows) {
        list.push_back(row_json(row, comparison.scene));
    }
    return list;
}

nlohmann::json results_json(const Comparison& comparison) {
    return {{"settings", comparison.settings},
            {"seeds", comparison.plan.seeds},
            {"time", comparison.plan.seconds},
            {"reference", reference_json(comparison.reference)},
            {"rows", comparison_json(comparison)}};
}

std::string rows_csv(std::span<const Comparison> comparisons) {
    std::vector<Cells> table = {{"scene", "sampling", "spp", "seconds", "work", "relmse", "relmse_trimmed",
                                 "error_p9999", "mse", "mape", "flip", "ratio", "relmse_median", "relmse_min",
                                 "relmse_max", "relmse_mean", "relmse_mean_error", "ratio_min", "ratio_max"}};
    for (const Comparison& comparison : comparisons) {
        for (const ComparisonRow& r : comparison.rows) {
            const Metrics& m = r.metrics;
            const Spread error = relmse_spread(r), ratio = ratio_spread(r);
            Cells& cells = table.emplace_back(Cells{comparison.scene, to_string(r.way)});
            append(cells, {r.samples, r.seconds, r.work, m.relmse, m.relmse_trimmed, m.error_p9999, m.mse, m.mape,
                           r.flip, r.ratio.value_or(none), error.median, error.min, error.max, error.mean,
                           error.std_error, ratio.min, ratio.max});
        }
    }
    return csv_text(table);
}

std::string runs_csv(std::span<const Comparison> comparisons) {
    std::vector<Cells> table = {{"scene", "sampling", "seed", "spp", "seconds", "work", "relmse", "relmse_std_error",
                                 "relmse_trimmed", "error_p9999", "mse", "mape", "ratio"}};
    for (const Comparison& comparison : comparisons) {
        for (const ComparisonRow& row : comparison.rows) {
            for (const ComparisonRun& run : row.runs) {
                const Metrics& m = run.metrics;
                Cells& cells =
                    table.emplace_back(Cells{comparison.scene, to_string(row.way), std::to_string(run.seed)});
                append(cells, {run.samples, run.seconds, run.work, m.relmse, m.relmse_std_error, m.relmse_trimmed,
                               m.error_p9999, m.mse, m.mape, run.ratio.value_or(none)});
            }
        }
    }
    return csv_text(table);
}

std::string curves_csv(std::span<const Comparison> comparisons) {
    std::vector<Cells> table = {{"scene", "sampling", "seed", "spp", "seconds", "work", "relmse", "relmse_trimmed"}};
    for (const Comparison& comparison : comparisons) {
        for (const ComparisonRow& row : comparison.rows) {
            for (const ComparisonRun& run : row.runs) {
                for (const ConvergenceSeries::Point& p : run.points) {
                    Cells& cells =
                        table.emplace_back(Cells{comparison.scene, to_string(row.way), std::to_string(run.seed)});
                    append(cells, {p.samples, p.seconds, p.work, p.relmse, p.relmse_trimmed});
                }
            }
        }
    }
    return csv_text(table);
}

}  // namespace wend
