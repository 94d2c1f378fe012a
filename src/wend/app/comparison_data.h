// What comparisons found, in numbers: as text, JSON and CSV.
#pragma once

#include <wend/app/comparison.h>
#include <wend/stats/spread.h>

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace wend {

/// relMSE over the runs of a row.
Spread relmse_spread(const ComparisonRow& row);
/// ComparisonRun::ratio over the runs of a row; of no value where there is none.
Spread ratio_spread(const ComparisonRow& row);

/// How walks were guided: as JSON, the gain of each kind over the first one among it.
nlohmann::json kinds_json(const std::vector<WalkKindStatistics>& kinds);

/// The rows as text.
std::string comparison_table(const std::vector<ComparisonRow>& rows);

/// The rows as the contract's JSON: of each its median run, the spread over all runs, and every run with the pictures
/// on its way.
nlohmann::json comparison_json(const Comparison& comparison);

/// All about one comparison: its settings, reference and rows.
nlohmann::json results_json(const Comparison& comparison);

/// One line for each way of sampling of each scene, for each render, and for each picture on the way of a render: CSV
/// (RFC 4180) below a line of names. What is no finite number is empty.
std::string rows_csv(std::span<const Comparison> comparisons);
std::string runs_csv(std::span<const Comparison> comparisons);
std::string curves_csv(std::span<const Comparison> comparisons);

}  // namespace wend
