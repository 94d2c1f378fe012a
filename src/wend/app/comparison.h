// Equal-time comparison of ways to sample a scene.
#pragma once

#include <wend/app/convergence_plot.h>
#include <wend/app/session.h>
#include <wend/film/metrics.h>

#include <optional>
#include <string>
#include <vector>

namespace wend {

/// One way of sampling: its median run over the seeds.
struct ComparisonRow {
    Preset preset;
    double samples = 0;
    double seconds = 0;
    Metrics metrics;  ///< but error_p9999 is of the pixels of all runs: one run has few beyond it
    double flip = 0;
    std::optional<double> ratio;  ///< relMSE times seconds of classical sampling, over the same of this row
    Image image;
    std::vector<Layer> walks;  ///< Film::walk_layers()
    ConvergenceSeries convergence;
};

/// Renders the scene with every preset for `seconds` each, presets taking turns, once a seed, and measures against the
/// reference.
std::vector<ComparisonRow> compare_presets(const Session& session, const std::vector<Preset>& presets, double seconds,
                                           int seeds, const Reference& reference, const CommonOptions& common,
                                           const Streams& streams);

/// The rows as text.
std::string comparison_table(const std::vector<ComparisonRow>& rows);
/// The rows as the contract's JSON.
nlohmann::json comparison_json(const std::vector<ComparisonRow>& rows);

}  // namespace wend
