// All samplers of the laboratory at a series of albedos: the table of the talk, and more.
#pragma once

#include <wend/app/options.h>
#include <wend/lab/lab.h>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace wend {

struct HalfspaceRow {
    PlanarExperiment experiment;
    PlanarResult result;
    std::optional<double> closed_form;  ///< variance of one walk, where theory knows it
    std::optional<double> gain;         ///< figure of merit over that of `classical` at this albedo
};

/// The experiments of the table: those samplers and albedos, all else as in `base`.
std::vector<PlanarExperiment> halfspace_experiments(const PlanarExperiment& base);

/// Runs them in turn, telling before each which one it is.
std::vector<HalfspaceRow> run_halfspace_table(const std::vector<PlanarExperiment>& experiments, const PlanarRun& run,
                                              const std::function<void(std::size_t index)>& progress);

/// The table as cells of text, the first row its head; the first two columns are words.
std::vector<std::vector<std::string>> halfspace_cells(const std::vector<HalfspaceRow>& rows);
nlohmann::json halfspace_json(const std::vector<HalfspaceRow>& rows, const PlanarRun& run);

}  // namespace wend
