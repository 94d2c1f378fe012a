// The result of one experiment of the planar laboratory, for people and for scripts.
#pragma once

#include <wend/app/options.h>
#include <wend/lab/lab.h>

#include <cstdint>
#include <optional>
#include <string>

namespace wend {

/// The contract's keys, and the settings. Values are numbers, or arrays with one for each channel of a chromatic
/// medium.
nlohmann::json planar_json(const PlanarExperiment& experiment, const PlanarRun& run, const PlanarResult& result);

/// A small table with units.
std::string planar_text(const PlanarExperiment& experiment, const PlanarRun& run, const PlanarResult& result);

/// A mean with the digits that its standard error leaves.
std::string mean_text(const Moments& moments);
/// An exact value; a dash where there is none.
std::string exact_text(double exact);
/// How many standard errors the mean lies from the exact value; a dash where that cannot be said.
std::string deviation_text(const Moments& moments, double exact);
/// A figure of merit or a ratio of two; a dash where there is none.
std::string merit_text(const std::optional<double>& merit);

/// Says so where walks had to be counted as 0 because their value was not finite.
void warn_of_rejected(std::uint64_t rejected, const Streams& streams);

/// Runs an experiment and reports to where the options say: table or JSON to standard output, warnings to the other.
void report_planar(const PlanarExperiment& experiment, const PlanarRun& run, const CommonOptions& common,
                   const Streams& streams);

}  // namespace wend
