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
    Metrics metrics;
    double flip = 0;
    std::optional<double> ratio;  ///< relMSE times seconds of classical sampling, over the same of this row
    Image image;                  ///< of the median run
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

/// Makes the folder for write_comparison(). Throws InputError where that cannot be.
void make_report_folder(const std::filesystem::path& folder);

/// Writes pictures, error maps and index.html into a folder that exists.
void write_comparison(const std::filesystem::path& folder, const Session& session,
                      const std::vector<ComparisonRow>& rows, const Reference& reference, double seconds, int seeds);

}  // namespace wend
