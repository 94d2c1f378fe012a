// How gains over classical sampling are distributed over scenes.
#pragma once

#include <wend/app/comparison.h>
#include <wend/stats/spread.h>

#include <nlohmann/json_fwd.hpp>

#include <span>
#include <string>
#include <vector>

namespace wend {

/// The gain of one way of sampling in one scene.
struct SceneGain {
    std::size_t scene = 0;  ///< index among the comparisons
    double gain = 1;        ///< ComparisonRow::ratio
    Spread runs;            ///< ratio_spread()
};

/// The gains of one way of sampling. The numbers are NaN where no gain is known.
struct GainDistribution {
    std::string sampling;
    std::vector<SceneGain> scenes;     ///< the worst first
    std::vector<std::size_t> unknown;  ///< scenes whose gain is no positive number: an error was not above 0
    double geometric_mean = 0;
    double error_factor = 0;  ///< exp of the standard error of the mean logarithm, by scenes; NaN for one scene
    double min = 0, p10 = 0, p25 = 0, median = 0, p75 = 0, p90 = 0, max = 0;
    std::size_t losses = 0;  ///< scenes with a gain below 1
};

/// Of every way but the classical one, in the order in which they first occur. Empty where nothing was sampled
/// classically.
std::vector<GainDistribution> gain_distributions(std::span<const Comparison> comparisons);

/// As JSON, scenes by the names of their files.
nlohmann::json gains_json(const std::vector<GainDistribution>& gains, std::span<const Comparison> comparisons);

/// As text.
std::string gains_table(const std::vector<GainDistribution>& gains, std::span<const Comparison> comparisons);

}  // namespace wend
