// Equal-time comparison of ways to sample a scene.
#pragma once

#include <wend/app/convergence_plot.h>
#include <wend/app/session.h>
#include <wend/film/metrics.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace wend {

/// What is compared.
struct WayOfSampling {
    Preset preset;
    SubsurfacePreset subsurface;

    bool is_classical() const { return preset == Preset() && subsurface.is_classical(); }
};

/// "full", or "full/dwivedi" where the subsurface sampling is not the default.
std::string to_string(const WayOfSampling& way);

/// One render of a comparison, in numbers.
struct ComparisonRun {
    double samples = 0;
    double seconds = 0;
    Metrics metrics;
    std::vector<ConvergenceSeries::Point> points;  ///< on its way
};

/// One way of sampling: its median run over the seeds.
struct ComparisonRow {
    WayOfSampling way;
    double samples = 0;
    double seconds = 0;
    Metrics metrics;  ///< but error_p9999 is of the pixels of all runs: one run has few beyond it
    double flip = 0;
    std::optional<double> ratio;  ///< relMSE times seconds of classical sampling, over the same of this row
    Image image;
    std::vector<Layer> walks;  ///< Film::walk_layers()
    std::vector<WalkKindStatistics> kinds;
    ConvergenceSeries convergence;
    std::vector<ComparisonRun> runs;  ///< in the order of the seeds
};

/// Is told of a render as it goes on, first at its start; may throw, which ends the comparison.
using ComparisonWatcher = std::function<void(const WayOfSampling& way, int seed, const RenderProgress& progress)>;

/// Shows the progress of a comparison by so many seeds as bars.
ComparisonWatcher comparison_bars(int seeds, const CommonOptions& common, const Streams& streams);

/// Renders the scene in every way for `seconds` each, ways taking turns, once a seed, and measures against the
/// reference.
std::vector<ComparisonRow> compare_presets(const Session& session, const std::vector<WayOfSampling>& ways,
                                           double seconds, int seeds, const Reference& reference,
                                           const ComparisonWatcher& watcher);

/// How walks were guided: as JSON, the gain of each kind over the first one among it.
nlohmann::json kinds_json(const std::vector<WalkKindStatistics>& kinds);

/// The rows as text.
std::string comparison_table(const std::vector<ComparisonRow>& rows);
/// The rows as the contract's JSON.
nlohmann::json comparison_json(const std::vector<ComparisonRow>& rows);

}  // namespace wend
