// Planar walks one by one, for what a mean and a variance do not tell.
#pragma once

#include <wend/lab/build.h>

#include <cmath>
#include <cstdint>
#include <vector>

namespace wend::test {

/// The values of single walks.
inline std::vector<double> walk_values(const auto& walker, std::size_t count, std::uint64_t seed) {
    Pcg32 random(seed);
    UnobservedWalk nobody;
    std::uint64_t collisions = 0;
    std::vector<double> values(count);
    for (double& value : values) {
        value = walker.walk(random, collisions, nobody);
    }
    return values;
}

inline std::vector<double> walk_values(const PlanarExperiment& e, std::size_t count, std::uint64_t seed) {
    return planar_build::with_walker(e, [&](const auto& walker) { return walk_values(walker, count, seed); });
}

/// A sample variance s² and its own standard error, sqrt((m4 - s⁴) / n) with the fourth central moment m4.
struct VarianceEstimate {
    double mean = 0;
    double variance = 0;
    double standard_error = 0;
};

inline VarianceEstimate variance_of(const std::vector<double>& values) {
    const auto n = static_cast<double>(values.size());
    VarianceEstimate estimate;
    for (const double x : values) {
        estimate.mean += x / n;
    }
    double fourth = 0;
    for (const double x : values) {
        const double square = (x - estimate.mean) * (x - estimate.mean);
        estimate.variance += square / n;
        fourth += square * square / n;
    }
    estimate.standard_error = std::sqrt((fourth - estimate.variance * estimate.variance) / n);
    return estimate;
}

}  // namespace wend::test
