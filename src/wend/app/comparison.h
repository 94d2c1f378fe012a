// Equal-time comparison of ways to sample a scene.
#pragma once

#include <wend/app/convergence_plot.h>
#include <wend/app/reference.h>
#include <wend/app/session.h>
#include <wend/film/error_terms.h>
#include <wend/film/metrics.h>

#include <nlohmann/json.hpp>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace wend {

/// One way to sample, of those that are compared.
struct WayOfSampling {
    Preset preset;
    SubsurfacePreset subsurface;

    bool is_classical() const { return preset == Preset() && subsurface.is_classical(); }
};

/// "full", or "full/dwivedi" where the subsurface sampling is not the default.
std::string to_string(const WayOfSampling& way);

/// What is compared, and for how long.
struct ComparisonPlan {
    std::vector<WayOfSampling> ways;
    double seconds = 30;  ///< of each render, training included
    int seeds = 3;        ///< renders of each way
};

/// One render of a comparison, in numbers.
struct ComparisonRun {
    std::uint64_t seed = 0;
    double samples = 0;  ///< per pixel
    double seconds = 0;
    double work = 0;  ///< segments of all its walks
    Metrics metrics;
    std::optional<double> ratio;                   ///< as ComparisonRow::ratio, against the classical run of its turn
    std::vector<ConvergenceSeries::Point> points;  ///< on its way, the last one at its end
};

/// One way of sampling: its median run over the seeds.
struct ComparisonRow {
    WayOfSampling way;
    double samples = 0;
    double seconds = 0;
    double work = 0;
    Metrics metrics;  ///< but error_p9999 is of the pixels of all runs: one run has few beyond it
    double flip = 0;
    std::optional<double> ratio;  ///< relMSE times seconds of classical sampling, over the same of this row
    Image image;
    ErrorTerms errors;         ///< pixel by pixel, as means over all runs
    std::vector<Layer> walks;  ///< Film::walk_layers()
    std::vector<WalkKindStatistics> kinds;
    ConvergenceSeries convergence;
    std::vector<ComparisonRun> runs;  ///< in the order of the seeds
};

/// The comparison of one scene, independent of the scene itself.
struct Comparison {
    std::string scene;        ///< its file
    nlohmann::json settings;  ///< Session::describe() of what all renders have in common
    ComparisonPlan plan;
    KnownReference reference;
    std::vector<ComparisonRow> rows;  ///< one for each way, in their order
};

/// Is told of a render as it goes on, first at its start; may throw, which ends the comparison.
using ComparisonWatcher = std::function<void(const WayOfSampling& way, int seed, const RenderProgress& progress)>;

/// Shows the progress of a comparison by so many seeds as bars, whose names begin with the label.
ComparisonWatcher comparison_bars(int seeds, const CommonOptions& common, const Streams& streams,
                                  const std::string& label = "");

/// Renders the scene in every way, ways taking turns, once a seed, and measures against the reference. Throws
/// InputError where the reference is of another size.
Comparison compare_presets(const Session& session, const ComparisonPlan& plan, KnownReference reference,
                           const ComparisonWatcher& watcher);

}  // namespace wend
