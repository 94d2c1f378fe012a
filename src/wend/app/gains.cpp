#include <wend/app/gains.h>

#include <wend/app/comparison_data.h>
#include <wend/app/text_table.h>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>

namespace wend {
namespace {

/// The distribution of a way of this name; a new one where there is none yet.
GainDistribution& distribution_of(std::vector<GainDistribution>& all, const std::string& sampling) {
    const auto found =
        std::find_if(all.begin(), all.end(), [&](const GainDistribution& d) { return d.sampling == sampling; });
    if (found != all.end()) {
        return *found;
    }
    all.emplace_back().sampling = sampling;
    return all.back();
}

void summarize(GainDistribution& d) {
    std::stable_sort(d.scenes.begin(), d.scenes.end(),
                     [](const SceneGain& a, const SceneGain& b) { return a.gain < b.gain; });
    std::vector<double> gains, logarithms;
    for (const SceneGain& one : d.scenes) {
        gains.push_back(one.gain);
        logarithms.push_back(std::log(one.gain));
        d.losses += one.gain < 1 ? 1 : 0;
    }
    const Spread spread = spread_of(logarithms);
    d.geometric_mean = std::exp(spread.mean);
    d.error_factor = std::exp(spread.std_error);
    d.min = quantile(gains, 0);
    d.p10 = quantile(gains, 0.1);
    d.p25 = quantile(gains, 0.25);
    d.median = quantile(gains, 0.5);
    d.p75 = quantile(gains, 0.75);
    d.p90 = quantile(gains, 0.9);
    d.max = quantile(gains, 1);
}

}  // namespace

std::vector<GainDistribution> gain_distributions(std::span<const Comparison> comparisons) {
    std::vector<GainDistribution> all;
    for (std::size_t scene = 0; scene < comparisons.size(); ++scene) {
        for (const ComparisonRow& row : comparisons[scene].rows) {
            if (row.way.is_classical() || !row.ratio) {
                continue;
            }
            GainDistribution& d = distribution_of(all, to_string(row.way));
            if (std::isfinite(*row.ratio) && *row.ratio > 0) {
                d.scenes.push_back({scene, *row.ratio, ratio_spread(row)});
            } else {
                d.unknown.push_back(scene);
            }
        }
    }
    for (GainDistribution& d : all) {
        summarize(d);
    }
    return all;
}

nlohmann::json gains_json(const std::vector<GainDistribution>& gains, std::span<const Comparison> comparisons) {
    nlohmann::json list = nlohmann::json::array();
    for (const GainDistribution& d : gains) {
        nlohmann::json scenes = nlohmann::json::array(), unknown = nlohmann::json::array();
        for (const SceneGain& one : d.scenes) {
            scenes.push_back({{"scene", comparisons[one.scene].scene},
                              {"gain", one.gain},
                              {"min", json_number(one.runs.min)},
                              {"max", json_number(one.runs.max)}});
        }
        for (const std::size_t scene : d.unknown) {
            unknown.push_back(comparisons[scene].scene);
        }
        list.push_back({{"sampling", d.sampling},
                        {"geometric_mean", json_number(d.geometric_mean)},
                        {"error_factor", json_number(d.error_factor)},
                        {"min", json_number(d.min)},
                        {"p10", json_number(d.p10)},
                        {"p25", json_number(d.p25)},
                        {"median", json_number(d.median)},
                        {"p75", json_number(d.p75)},
                        {"p90", json_number(d.p90)},
                        {"max", json_number(d.max)},
                        {"losses", d.losses},
                        {"scenes", std::move(scenes)},
                        {"unknown", std::move(unknown)}});
    }
    return list;
}

std::string gains_table(const std::vector<GainDistribution>& gains, std::span<const Comparison> comparisons) {
    std::vector<std::vector<std::string>> table = {
        {"gain over classical", "worst scene", "scenes", "geometric mean", "worst", "25 %", "median", "75 %", "best"}};
    for (const GainDistribution& d : gains) {
        std::vector<std::string>& cells = table.emplace_back(
            std::vector<std::string>{d.sampling, d.scenes.empty() ? "-" : comparisons[d.scenes.front().scene].scene,
                                     std::to_string(d.scenes.size())});
        for (const double value : {d.geometric_mean, d.min, d.p25, d.median, d.p75, d.max}) {
            cells.push_back(std::isfinite(value) ? fmt::format("{:.2f}", value) : "-");
        }
    }
    return text_table(table, 2);
}

}  // namespace wend
